// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionFinder_h
#define tippPartitionFinder_h

#include "Triangulation/CellGrid.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Tiling.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tipp
{

/// Finds the partitions of very many points: a grid of cells over the domain tells how far down the
/// tiling's tree all points of a cell go together, for most cells to a box.
class VTKTIPPFILTERS_EXPORT PartitionFinder
{
public:
  /// The tiling has to stay as it is.
  explicit PartitionFinder(const Tiling& tiling);

  /// The label of a point that is not finite.
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  /// With None for those that are not finite.
  void locate(const Point2* points, std::size_t count, std::uint32_t* partitions) const;

  /// Labels points [begin, end) with their partitions, and adds them to the partitions' counts.
  void label(PointsView points, std::size_t begin, std::size_t end, std::uint32_t* labels,
    std::vector<std::size_t>& counts) const;

private:
  struct Block
  {
    std::uint32_t Begin[2]; ///< first column and row
    std::uint32_t End[2];
  };

  void fill(std::int32_t node, const Block& block);

  const Tiling& Boxes;
  CellGrid Cells;
  /// Of each cell: the node to begin with, or ~ the partition that all of it is in. The cell after
  /// the last is that of points that are not finite; it is as if undecided.
  std::vector<std::int32_t> Starts;
};

} // namespace tipp

#endif
