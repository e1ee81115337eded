// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionFinder_h
#define tippPartitionFinder_h

#include "Kernel/Lanes.h"
#include "Predicates/Point2.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tipp
{

/// A grid of equal cells over a box, numbered row by row; the number after the last is that of
/// points that are not finite.
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
  /// By cell: the node to start at, or ~p if all of it is in partition p. The cell after the last
  /// is that of points that are not finite; it is treated as undecided.
  std::vector<std::int32_t> Starts;
};

} // namespace tipp

#endif
