// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPixelSizes_h
#define tippPixelSizes_h

#include "Check/ExactTests.h"

#include <cstddef>
#include <vector>

namespace tipp
{
namespace check
{

/// Sizes at the pixels of a raster, from which an upper bound of any interpolation follows: the
/// largest size near a position.
class PixelSizes
{
public:
  /// `sizes`: row by row from the lowest row, NaN where there is none. `first` is the centre of the
  /// first pixel, and `pixel` the width and height of all. There must be a pixel.
  PixelSizes(std::vector<double> sizes, std::size_t columns, Position first, Position pixel);

  /// Returns the smallest size; infinity if there is none.
  double smallest() const;

  /// Replaces each size by the largest one of the pixels whose centre is at most `reach`, and one
  /// pixel more, away in x and in y. Pixels without a size count only where no other is in reach.
  void spread(Position reach);

  /// Returns the size of the pixel at a position or, outside, of the nearest one; infinity if it
  /// has none.
  double at(Position p) const;

private:
  std::vector<double> Sizes;
  std::size_t Columns;
  Position First;
  Position Pixel;
};

} // namespace check
} // namespace tipp

#endif
