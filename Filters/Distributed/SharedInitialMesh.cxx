// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/SharedInitialMesh.h"

#include "Kernel/DelaunayKernel.h"
#include "Triangulation/KernelCells.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

using Index = DelaunayKernel::Index;

/// Triangulates the points around the chosen partitions, and inserts more of them until the
/// triangles that meet these, and their neighbours, are triangles of the initial mesh.
class PartMaker
{
public:
  PartMaker(const Regions& regions, const std::vector<BoundaryVertex>& initial,
    const std::vector<BoundaryVertex>& artificial, const std::vector<char>& isChosen, int threads)
    : Boxes(regions)
    , Initial(initial)
    , Artificial(artificial)
    , Choice{ isChosen, Box2::empty() }
    , Threads(threads)
    , Begins(isChosen.size(), 0)
    , Ends(isChosen.size(), 0)
    , IsComplete(isChosen)
  {
    for (std::size_t i = 0; i < initial.size(); ++i)
    {
      const auto p = std::size_t(initial[i].Partition);
      this->Begins[p] = this->Ends[p] == 0 ? i : this->Begins[p];
      this->Ends[p] = i + 1;
    }
    for (PartitionIndex p = 0; p < regions.size(); ++p)
    {
      if (isChosen[std::size_t(p)] && regions.areUsed()[std::size_t(p)])
      {
        this->Choice.Bounds.extend(regions[p]);
        this->IsAny = true;
      }
    }
  }

  BoundaryTriangles make()
  {
    if (this->IsAny)
    {
      do
      {
        this->triangulate();
        this->findTriangles();
        this->addNeighbours();
      } while (this->completeMet());
      this->Found.Mesh.Vertices = std::move(this->Vertices);
      this->Found.Mesh.AdjacentSets = adjacentSets<3>(this->Kernel, this->Sets);
    }
    return std::move(this->Found.Mesh);
  }

private:
  /// Inserts all initial points of complete partitions, and one of every few others.
  void triangulate()
  {
    constexpr std::size_t every = 16;
    std::vector<BoundaryVertex>& vertices = this->Vertices;
    vertices.clear();
    for (std::size_t p = 0; p < this->Begins.size(); ++p)
    {
      const std::size_t end = this->IsComplete[p]
        ? this->Ends[p]
        : std::min(this->Ends[p], this->Begins[p] + (p % every == 0 ? 1 : 0));
      vertices.insert(vertices.end(), this->Initial.begin() + std::ptrdiff_t(this->Begins[p]),
        this->Initial.begin() + std::ptrdiff_t(end));
    }
    vertices.insert(vertices.end(), this->Artificial.begin(), this->Artificial.end());
    const std::vector<Point2> points = positionsOf(vertices);
    this->Kernel.clear();
    this->Kernel.insert(points.data(), points.size());
  }

  /// Finds the triangles that meet a chosen partition.
  void findTriangles()
  {
    this->Found = findCells<2>(this->Kernel, this->Boxes, &this->Choice, this->Threads);
    this->Sets.assign(this->Kernel.triangleCount(), NoSet);
    for (std::size_t i = 0; i < this->Found.Indices.size(); ++i)
    {
      this->Sets[DelaunayKernel::number(this->Found.Indices[i])] = this->Found.Mesh.SetOf[i];
    }
  }

  void addNeighbours()
  {
    const std::size_t count = this->Found.Indices.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      for (Index edge = 0; edge < 3; ++edge)
      {
        const Index other = this->Kernel.neighbour(this->Found.Indices[i], edge);
        std::uint32_t& set = this->Sets[DelaunayKernel::number(other)];
        if (set == NoSet && !this->Kernel.isInfinite(other))
        {
          this->Found.add(this->Kernel, other, this->Boxes, nullptr);
          set = this->Found.Mesh.SetOf.back();
        }
      }
    }
  }

  /// Completes the partitions that the triangles meet. Returns false if all are complete.
  bool completeMet()
  {
    bool isAny = false;
    const PartitionSets& sets = this->Found.Mesh.Sets;
    for (std::uint32_t set = 0; set < sets.size(); ++set)
    {
      for (auto p = sets.begin(set); p != sets.end(set); ++p)
      {
        isAny = isAny || !this->IsComplete[std::size_t(*p)];
        this->IsComplete[std::size_t(*p)] = 1;
      }
    }
    return isAny;
  }

  const Regions& Boxes;
  const std::vector<BoundaryVertex>& Initial;
  const std::vector<BoundaryVertex>& Artificial;
  RegionChoice<2> Choice; ///< the chosen partitions' regions
  const int Threads;
  std::vector<std::size_t> Begins; ///< index of each partition's first point in Initial
  std::vector<std::size_t> Ends;
  std::vector<char> IsComplete; ///< by partition: all its initial points are inserted
  bool IsAny = false;           ///< whether a chosen partition has points
  DelaunayKernel Kernel;
  std::vector<BoundaryVertex> Vertices; ///< the kernel's points
  KernelCells<2> Found;
  std::vector<std::uint32_t> Sets; ///< by the kernel's triangle: its set in Found
};

} // namespace

void keepOneOfEachPosition(std::vector<BoundaryVertex>& vertices)
{
  const auto key = [](const BoundaryVertex& v)
  { return std::make_tuple(v.Partition, v.Position.x, v.Position.y); };
  std::sort(vertices.begin(), vertices.end(),
    [&](const BoundaryVertex& a, const BoundaryVertex& b)
    { return std::make_pair(key(a), a.Id) < std::make_pair(key(b), b.Id); });
  vertices.erase(
    std::unique(vertices.begin(), vertices.end(),
      [&](const BoundaryVertex& a, const BoundaryVertex& b) { return key(a) == key(b); }),
    vertices.end());
}

InitialMeshPart::InitialMeshPart(const Regions& regions, const std::vector<BoundaryVertex>& initial,
  const std::vector<BoundaryVertex>& artificial, const std::vector<char>& isChosen, int threads)
  : Mesh(PartMaker(regions, initial, artificial, isChosen, threads).make())
  , IsChosen(isChosen)
{
}

void InitialMeshPart::countMet(std::int64_t& triangles, std::int64_t& met) const
{
  for (std::size_t i = 0; i < this->Mesh.size(); ++i)
  {
    // A triangle in several parts is counted only in the part that chose the first partition it
    // meets.
    const PartitionIndex* const first = this->Mesh.metBegin(i);
    if (first != this->Mesh.metEnd(i) && this->IsChosen[std::size_t(*first)])
    {
      ++triangles;
      met += this->Mesh.metEnd(i) - first;
    }
  }
}

PartConflicts InitialMeshPart::conflicts() const
{
  const std::optional<ConflictGraph> graph = findConflicts(this->Mesh, this->IsChosen.size());
  PartConflicts conflicts;
  conflicts.IsTotal = !graph;
  for (PartitionIndex p = 0; graph && std::size_t(p) < this->IsChosen.size(); ++p)
  {
    if (this->IsChosen[std::size_t(p)])
    {
      conflicts.Rows.push_back({ p, graph->neighbours(p) });
    }
  }
  return conflicts;
}

std::optional<ConflictGraph> joinConflicts(
  const std::vector<PartConflicts>& parts, std::size_t partitions)
{
  const auto isPartition = [partitions](PartitionIndex p)
  { return p >= 0 && std::size_t(p) < partitions; };
  bool isTotal = false;
  std::vector<std::vector<PartitionIndex>> neighbours(partitions);
  for (const PartConflicts& part : parts)
  {
    isTotal = part.IsTotal || isTotal;
    for (const PartConflicts::Row& row : part.Rows)
    {
      if (!isPartition(row.Partition) ||
        !std::all_of(row.Neighbours.begin(), row.Neighbours.end(), isPartition))
      {
        throw std::runtime_error("A message from another rank is damaged: no such partition.");
      }
      neighbours[std::size_t(row.Partition)] = row.Neighbours;
    }
  }
  ConflictGraph graph(std::move(neighbours));
  if (isTotal || graph.neighbourCount() > mostConflicts(partitions))
  {
    return std::nullopt;
  }
  return graph;
}

} // namespace tipp
