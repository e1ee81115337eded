// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBoundaryCells_h
#define tippBoundaryCells_h

#include "Engine/MetPartitions.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Regions.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace tipp
{

/// A vertex of a boundary cell, with the data that a worker needs. A boundary cell is a triangle or
/// tetrahedron that is not interior to one partition.
template <typename Point>
struct VertexOf
{
  Point Position;           ///< coordinates of the vertex
  std::int64_t Id;          ///< the input point's id; negative for artificial points
  PartitionIndex Partition; ///< the partition that contains it
  std::int32_t Padding = 0; ///< so that all bytes of a message are defined

  bool isArtificial() const { return this->Id < 0; }
};

using BoundaryVertex = VertexOf<Point2>;
using Vertex3 = VertexOf<Point3>;

/// A boundary cell, by its corners.
template <int D>
using BoundaryCell = std::array<VertexOf<Point<D>>, D + 1>;
using BoundaryTriangle = BoundaryCell<2>;

///@{
/// The ids or positions of a cell's corners.
template <typename Vertex, std::size_t Corners>
std::array<std::int64_t, Corners> idsOf(const std::array<Vertex, Corners>& cell)
{
  std::array<std::int64_t, Corners> ids{};
  std::transform(cell.begin(), cell.end(), ids.begin(), [](const Vertex& v) { return v.Id; });
  return ids;
}
template <typename Vertex, std::size_t Corners>
auto positionsOf(const std::array<Vertex, Corners>& cell)
{
  std::array<decltype(Vertex::Position), Corners> positions;
  std::transform(
    cell.begin(), cell.end(), positions.begin(), [](const Vertex& v) { return v.Position; });
  return positions;
}
///@}

/// The positions of vertices, or of other points that have one.
template <typename Vertex>
auto positionsOf(const std::vector<Vertex>& vertices)
{
  std::vector<decltype(Vertex::Position)> positions;
  positions.reserve(vertices.size());
  for (const Vertex& v : vertices)
  {
    positions.push_back(v.Position);
  }
  return positions;
}

/// If the cell has an artificial corner, adds its true corners to `vertices` and returns true. The
/// hull repair needs these vertices.
template <typename Vertex, std::size_t Corners>
bool takeHullVertices(const std::array<Vertex, Corners>& cell, std::vector<Vertex>& vertices)
{
  const auto isArtificial = [](const Vertex& v) { return v.isArtificial(); };
  const bool isHull = std::any_of(cell.begin(), cell.end(), isArtificial);
  if (isHull)
  {
    std::remove_copy_if(cell.begin(), cell.end(), std::back_inserter(vertices), isArtificial);
  }
  return isHull;
}

/// Sorts vertices by id and removes repetitions.
template <typename Vertex>
void keepUnique(std::vector<Vertex>& vertices)
{
  std::sort(
    vertices.begin(), vertices.end(), [](const Vertex& a, const Vertex& b) { return a.Id < b.Id; });
  vertices.erase(std::unique(vertices.begin(), vertices.end(),
                   [](const Vertex& a, const Vertex& b) { return a.Id == b.Id; }),
    vertices.end());
}

constexpr std::uint32_t NoSet = ~0U; ///< the set of an infinite cell, or of one that is left out

/// Returns the set of each of a kernel's cells by the cell's number; NoSet for infinite ones.
/// `setOf` is indexed by finite cell, in the kernel's order.
template <typename Kernel>
std::vector<std::uint32_t> setsByNumber(
  const Kernel& kernel, const std::vector<std::uint32_t>& setOf)
{
  std::vector<std::uint32_t> sets;
  auto set = setOf.begin();
  kernel.forEach(
    [&](typename Kernel::Index cell)
    {
      sets.resize(Kernel::number(cell) + 1, NoSet);
      sets.back() = kernel.isInfinite(cell) ? NoSet : *set++;
    });
  return sets;
}

/// Returns the pairs of different sets of a kernel's adjacent cells. `sets` is indexed by cell
/// number.
template <int Corners, typename Kernel>
auto adjacentSets(const Kernel& kernel, const std::vector<std::uint32_t>& sets)
{
  using Index = typename Kernel::Index;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  kernel.forEach(
    [&](Index cell)
    {
      const std::uint32_t one = sets[Kernel::number(cell)];
      for (Index i = 0; i < Corners; ++i)
      {
        const std::uint32_t other = sets[Kernel::number(kernel.neighbour(cell, i))];
        if (one < other && other != NoSet)
        {
          pairs.emplace_back(one, other);
        }
      }
    });
  return pairs;
}

/// Cells, and for each the partitions that its circumball meets.
template <int D>
struct BoundaryCells : MetPartitions
{
  using Corners = std::array<std::uint32_t, D + 1>; ///< indices into Vertices

  std::vector<VertexOf<Point<D>>> Vertices; ///< each once; some may belong to no cell
  std::vector<Corners> Cells;               ///< in positive orientation

  std::size_t size() const { return this->Cells.size(); }
  BoundaryCell<D> operator[](std::size_t i) const
  {
    BoundaryCell<D> cell;
    std::transform(this->Cells[i].begin(), this->Cells[i].end(), cell.begin(),
      [this](std::uint32_t corner) { return this->Vertices[corner]; });
    return cell;
  }

  /// Adds a cell of vertices that are present or will be added; it meets the partitions [metBegin,
  /// metEnd).
  void add(const Corners& corners, const PartitionIndex* metBegin, const PartitionIndex* metEnd)
  {
    this->Cells.push_back(corners);
    this->SetOf.push_back(this->Sets.number(metBegin, metEnd));
  }
  /// Appends the cells of `others`, which must have the same vertices.
  void append(const BoundaryCells& others);
};

using BoundaryTriangles = BoundaryCells<2>;

/// Moves a bound outward by the margin, but by at least a few units in the last place: when
/// coordinates are large and close together, rounding may remove the margin.
double outward(double bound, double direction, double margin);

/// Returns artificial points at the corners and along the edges of a rectangle around the domain
/// (chapter 2.4.1). Their distance from the domain and from each other is the width of a partition.
/// Their ids are -1, -2 and so on. Empty if the domain is too large for doubles to enclose it.
std::vector<BoundaryVertex> makeArtificialPoints(const Tiling& tiling);

/// Chooses a partition's points for the initial mesh, and returns their indices in `points`: the
/// extreme ones in x and y, and others evenly spaced in the input's order. With the extreme points,
/// fewer disks over voids meet many partitions, which halves the chains of conflicting partitions
/// of clustered points. If `wanted` is small, only evenly spaced points are chosen.
std::vector<std::size_t> chooseInitialPoints(
  const Point2* points, std::size_t count, std::size_t wanted);

/// Chooses `perPartition` points of each partition; their ids are the buckets' ids.
template <typename Id>
std::vector<BoundaryVertex> chooseInitialPoints(
  const Tiling& tiling, const PointBuckets<Id>& buckets, int perPartition, int threads)
{
  std::vector<std::vector<std::size_t>> chosen(std::size_t(tiling.size()));
  parallelFor(tiling.size(), threads,
    [&](std::int64_t i)
    {
      const auto p = static_cast<PartitionIndex>(i);
      chosen[std::size_t(i)] =
        chooseInitialPoints(buckets.points(p), buckets.count(p), std::size_t(perPartition));
    });
  std::vector<BoundaryVertex> vertices;
  for (PartitionIndex p = 0; p < tiling.size(); ++p)
  {
    for (const std::size_t at : chosen[std::size_t(p)])
    {
      vertices.push_back({ buckets.points(p)[at], buckets.id(p, at), p });
    }
  }
  return vertices;
}

/// The limit of partitionsPay() in the plane, if a mesh with four times as many points is tried
/// before partitions are given up. By measurement, circumdisks meet 2.7 partitions or more on
/// average for points on a circle, a parabola or a cubic, however many initial points there are.
/// For ordinary points they meet 1.8 to 3.0 with 8 initial points per partition, and 1.4 to 2.0
/// with 32.
constexpr double MostMetPartitions = 2.6;

/// Whether partitioning pays off: whether cells meet at most `most` partitions on average.
/// Otherwise every worker would get nearly all vertices. For points on a circle or a parabola the
/// average stays high with more initial points; for ordinary points it falls. Cells that meet no
/// partition do not count.
bool partitionsPay(const MetPartitions& initialMesh, double most = 3);
/// Whether partitioning pays off, from counts: the number of cells that meet partitions, and the
/// sum of the numbers of partitions that they meet.
bool partitionsPay(std::int64_t cells, std::int64_t met, double most = 3);

} // namespace tipp

#endif
