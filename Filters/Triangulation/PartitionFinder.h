// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionFinder_h
#define tippPartitionFinder_h

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

  void locate(const Point2* points, std::size_t count, std::uint32_t* partitions) const;

  /// The label of a point that is not finite.
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  /// Labels points [begin, end) with their partitions, and adds them to the partitions' counts.
  void label(PointsView points, std::size_t begin, std::size_t end, std::uint32_t* labels,
    std::vector<std::size_t>& counts) const;

private:
  /// Columns or rows. A coordinate's cell rises with it, whatever is rounded, so that a cut at a
  /// coordinate has all lower cells below it and all higher ones above.
  struct Cells
  {
    double Low = 0;
    double Scale = 0;
    std::uint32_t Last = 0;

    Cells(double low, double high, std::uint32_t count);

    std::uint32_t operator()(double x) const
    {
      const double cell = (x - this->Low) * this->Scale;
      const double last = this->Last;
      const double atLeast = cell > 0 ? cell : 0; // NaN, too
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(atLeast < last ? atLeast : last));
    }
  };
  struct Block
  {
    std::uint32_t Begin[2]; ///< first column and row
    std::uint32_t End[2];
  };

  void fill(std::int32_t node, const Block& block);

  const Tiling& Boxes;
  Cells Columns;
  Cells Rows;
  /// Of each cell, row by row: the node to begin with, or ~ the partition that all of it is in.
  std::vector<std::int32_t> Starts;
};

} // namespace tipp

#endif
