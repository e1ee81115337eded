// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTiling_h
#define tippTiling_h

#include "Engine/PartitionIndex.h"
#include "Kernel/Pairs.h"
#include "Parallel/Instructions.h"
#include "Predicates/Circumball.h"
#include "Predicates/Geometry.h"
#include "Triangulation/CutTree.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{

/// The number of points in a partition for which workers are fastest, by measurement.
constexpr std::int64_t BestPointsInPartition = 49152;
/// With fewer points in a partition, a worker's overhead is noticeable.
constexpr std::int64_t FewestPointsInPartition = 4096;
/// Partitions per thread; enough to keep all threads busy until the end.
constexpr std::int64_t PartitionsPerThread = 8;
/// Points of each partition in the initial mesh.
constexpr int InitialPointsOfPartition = 8;
/// Sample points per partition for balancing a tiling.
constexpr std::size_t SamplesPerPartition = 64;
/// The maximum number of partitions in a tiling; more would only cost memory.
constexpr std::int64_t MostPartitions = std::int64_t(1) << 24;

/// Throws std::length_error if a partition has too many points for the kernel's 32-bit half-edges.
inline void requireFitsKernel(std::size_t pointsInPartition)
{
  constexpr std::size_t most = 100'000'000; // well below the limit
  if (pointsInPartition > most)
  {
    throw std::length_error("A partition would hold " + std::to_string(pointsInPartition) +
      " points, more than " + std::to_string(most) +
      ": too many points are close together for the number of partitions, or they are all on one "
      "line.");
  }
}

/// The partitions' boxes: a domain cut in two repeatedly. For many points PartitionFinder is faster
/// than locate().
class VTKTIPPFILTERS_EXPORT Tiling : public CutTree<2>
{
public:
  /// Equal boxes, `columns` x `rows`. Throws std::length_error beyond MostPartitions.
  static Tiling grid(const Box2& domain, int columns, int rows);

  /// About `count` boxes that contain equally many of the sample's points.
  static Tiling balanced(const Box2& domain, std::vector<Point2> sample, int count);

  /// Replaces each box by the boxes of a tiling of it; `inner` is indexed by box.
  Tiling refined(const std::vector<Tiling>& inner) const;

  template <typename Archive>
  friend void serialize(Archive& archive, Tiling& tiling)
  {
    archive(tiling.Domain, tiling.Nodes, tiling.Count, tiling.Boxes);
  }

  const Box2& box(PartitionIndex i) const { return this->Boxes[static_cast<std::size_t>(i)]; }
  const Box2& domain() const { return this->Domain; }

  const std::vector<Box2>& boxes() const { return this->Boxes; }

  /// Calls visit(partition) for every box that the closed disk meets.
  template <typename Visit>
  void visitMet(const Circumdisk& disk, Visit&& visit) const
  {
    this->visitNear(disk.bounds(),
      [&](PartitionIndex p)
      {
        if (disk.meets(this->box(p)))
        {
          visit(p);
        }
      });
  }

private:
  friend class PartitionFinder;

  std::int32_t cutGrid(const Box2& box, int columns, int rows);
  std::int32_t cutSample(const Box2& box, Point2* begin, Point2* end, int count);
  std::int32_t addBox(const Box2& box, PartitionIndex partition);
  template <typename MakeBox>
  std::int32_t addTree(const Tiling& tree, std::int32_t from, const MakeBox& makeBox);

  Box2 Domain{};
  std::vector<Box2> Boxes;
};

/// A grid of equal cells over a box, numbered row by row. Non-finite points get the number after
/// the last cell's.
class VTKTIPPFILTERS_EXPORT CellGrid
{
public:
  /// The columns or the rows. The cell is a monotone function of the coordinate despite rounding,
  /// so a cut at a coordinate has all lower cells below it and all higher cells above it.
  struct Axis
  {
    double Low = 0;
    double Scale = 0;
    std::uint32_t Last = 0;

    Axis(double low, double high, std::uint32_t count);

    std::uint32_t size() const { return this->Last + 1; }

    std::uint32_t operator()(double x) const
    {
      const double cell = (x - this->Low) * this->Scale;
      const double last = static_cast<std::int32_t>(this->Last);
      const double atLeast = cell > 0 ? cell : 0; // also for NaN
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(atLeast < last ? atLeast : last));
    }
  };

  CellGrid(const Box2& box, std::uint32_t perSide);

  const Axis& columns() const { return this->Columns; }
  const Axis& rows() const { return this->Rows; }
  std::size_t size() const { return std::size_t(this->Columns.size()) * this->Rows.size(); }

  /// Computes the cell of each of `count` points. Points outside the box get the nearest border
  /// cell.
  void find(const Point2* points, std::size_t count, std::uint32_t* cells,
    Instructions instructions = Instructions::Best) const;

private:
  Axis Columns;
  Axis Rows;
};

/// Finds the partitions of many points. A grid of cells over the domain stores how far down the
/// tiling's tree all points of a cell share their path; for most cells this is to a box.
class VTKTIPPFILTERS_EXPORT PartitionFinder
{
public:
  /// The tiling must outlive this object and not change.
  explicit PartitionFinder(const Tiling& tiling);

  /// The partition index returned for a point that is not finite.
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  /// Computes the partition of each point; None if the point is not finite.
  void locate(const Point2* points, std::size_t count, std::uint32_t* partitions) const;

  /// Writes the partition of each point of [begin, end) to `labels`, which is indexed by input
  /// point, and adds the points to the partitions' counts.
  void label(PointsView points, std::size_t begin, std::size_t end, std::uint32_t* labels,
    std::vector<std::size_t>& counts) const;

private:
  /// A rectangular block of grid cells.
  struct Block
  {
    std::uint32_t Begin[2]; ///< first column and row
    std::uint32_t End[2];
  };

  void fill(std::int32_t node, const Block& block);

  const Tiling& Boxes;
  CellGrid Cells;
  /// By cell: the node to start at, or ~p if all of it is in partition p. The entry after the last
  /// cell is for non-finite points; it is treated as undecided.
  std::vector<std::int32_t> Starts;
};

} // namespace tipp

#endif
