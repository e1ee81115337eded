// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/RankRun.h"

#include "Kernel/DelaunayKernel.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

using Index = DelaunayKernel::Index;

constexpr std::uint32_t NoSet = ~0U;

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
    , IsChosen(isChosen)
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
    this->findBounds();
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
      this->addAdjacentSets();
    }
    return std::move(this->Mesh);
  }

private:
  void findBounds()
  {
    for (PartitionIndex p = 0; p < this->Boxes.size(); ++p)
    {
      if (this->IsChosen[std::size_t(p)] && this->Boxes.areUsed()[std::size_t(p)])
      {
        const Box2& box = this->Boxes[p];
        Box2& all = this->Bounds;
        all = this->IsAny ? Box2{ std::min(all.xmin, box.xmin), std::min(all.ymin, box.ymin),
          std::max(all.xmax, box.xmax), std::max(all.ymax, box.ymax) }
                          : box;
        this->IsAny = true;
      }
    }
  }

  /// Inserts all initial points of complete partitions, and one of every few others.
  void triangulate()
  {
    constexpr std::size_t every = 16;
    this->Mesh = {};
    this->Triangles.clear();
    std::vector<BoundaryVertex>& vertices = this->Mesh.Vertices;
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

  Circumdisk diskOf(Index t) const
  {
    const auto v = this->Kernel.corners(t);
    return { this->Kernel.point(v[0]), this->Kernel.point(v[1]), this->Kernel.point(v[2]) };
  }

  BoundaryTriangles::Corners cornersOf(Index t) const
  {
    const auto v = this->Kernel.corners(t);
    return { this->Kernel.pointIndex(v[0]), this->Kernel.pointIndex(v[1]),
      this->Kernel.pointIndex(v[2]) };
  }

  struct Found
  {
    BoundaryTriangles Mesh;
    std::vector<Index> Triangles; ///< in the kernel
  };

  /// The triangles in [begin, end) that meet a chosen partition.
  Found findTriangles(std::int64_t begin, std::int64_t end) const
  {
    Found found;
    std::vector<PartitionIndex> met;
    for (std::int64_t i = begin; i < end; ++i)
    {
      const Index t = DelaunayKernel::triangle(std::size_t(i));
      if (this->Kernel.isInfinite(t))
      {
        continue;
      }
      const Circumdisk disk = this->diskOf(t);
      if (!disk.meets(this->Bounds))
      {
        continue;
      }
      met.clear();
      this->Boxes.visitMet(disk, [&met](PartitionIndex p) { met.push_back(p); });
      if (std::any_of(met.begin(), met.end(),
            [this](PartitionIndex p) { return this->IsChosen[std::size_t(p)] != 0; }))
      {
        found.Mesh.add(this->cornersOf(t), met.data(), met.data() + met.size());
        found.Triangles.push_back(t);
      }
    }
    return found;
  }

  void findTriangles()
  {
    const auto triangles = std::int64_t(this->Kernel.triangleCount());
    std::vector<Found> parts(static_cast<std::size_t>(this->Threads));
    parallelFor(this->Threads, this->Threads,
      [&](std::int64_t i)
      {
        parts[std::size_t(i)] =
          this->findTriangles(triangles * i / this->Threads, triangles * (i + 1) / this->Threads);
      });
    for (const Found& part : parts)
    {
      this->Mesh.appendTriangles(part.Mesh);
      this->Triangles.insert(this->Triangles.end(), part.Triangles.begin(), part.Triangles.end());
    }
    this->Sets.assign(std::size_t(triangles), NoSet);
    for (std::size_t i = 0; i < this->Triangles.size(); ++i)
    {
      this->Sets[DelaunayKernel::number(this->Triangles[i])] = this->Mesh.SetOf[i];
    }
  }

  void addNeighbours()
  {
    std::vector<PartitionIndex> met;
    const std::size_t count = this->Triangles.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      for (Index edge = 0; edge < 3; ++edge)
      {
        const Index other = this->Kernel.neighbour(this->Triangles[i], edge);
        std::uint32_t& set = this->Sets[DelaunayKernel::number(other)];
        if (set == NoSet && !this->Kernel.isInfinite(other))
        {
          met.clear();
          this->Boxes.visitMet(this->diskOf(other), [&met](PartitionIndex p) { met.push_back(p); });
          this->Mesh.add(this->cornersOf(other), met.data(), met.data() + met.size());
          set = this->Mesh.SetOf.back();
          this->Triangles.push_back(other);
        }
      }
    }
  }

  /// Completes the partitions that the triangles meet. Returns false if all are complete.
  bool completeMet()
  {
    bool isAny = false;
    for (std::uint32_t set = 0; set < this->Mesh.Sets.size(); ++set)
    {
      for (auto p = this->Mesh.Sets.begin(set); p != this->Mesh.Sets.end(set); ++p)
      {
        isAny = isAny || !this->IsComplete[std::size_t(*p)];
        this->IsComplete[std::size_t(*p)] = 1;
      }
    }
    return isAny;
  }

  void addAdjacentSets()
  {
    for (const Index t : this->Triangles)
    {
      for (Index edge = 0; edge < 3; ++edge)
      {
        const std::uint32_t one = this->Sets[DelaunayKernel::number(t)];
        const std::uint32_t other =
          this->Sets[DelaunayKernel::number(this->Kernel.neighbour(t, edge))];
        if (one < other && other != NoSet)
        {
          this->Mesh.AdjacentSets.emplace_back(one, other);
        }
      }
    }
  }

  const Regions& Boxes;
  const std::vector<BoundaryVertex>& Initial;
  const std::vector<BoundaryVertex>& Artificial;
  const std::vector<char>& IsChosen;
  const int Threads;
  std::vector<std::size_t> Begins; ///< index of each partition's first point in Initial
  std::vector<std::size_t> Ends;
  std::vector<char> IsComplete; ///< by partition: all its initial points are inserted
  Box2 Bounds{};                ///< bounds of the chosen regions
  bool IsAny = false;           ///< whether a chosen partition has points
  DelaunayKernel Kernel;
  BoundaryTriangles Mesh;
  std::vector<Index> Triangles;    ///< those of Mesh in the kernel
  std::vector<std::uint32_t> Sets; ///< by the kernel's triangle: its set in Mesh
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
