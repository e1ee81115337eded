// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRasterGrid_h
#define tippRasterGrid_h

#include "vtkTIPPIOModule.h"

#include <array>
#include <cstdint>
#include <optional>

namespace tipp
{

/// The pixels of a raster: squares or rectangles in rows along x. A value is that of a pixel's
/// centre.
struct RasterGrid
{
  double West = 0;                        ///< border of the first column
  double South = 0;                       ///< border of the lowest row
  std::array<double, 2> Pixel = { 1, 1 }; ///< width and height
  std::int64_t Columns = 0;
  std::int64_t Rows = 0;

  double north() const { return this->South + double(this->Rows) * this->Pixel[1]; }
  std::int64_t pixels() const { return this->Columns * this->Rows; }
};

/// What a user asks of a raster's pixels.
struct RasterRequest
{
  double Resolution = 0;
  /// xmin, xmax, ymin, ymax; without: those of the points.
  std::optional<std::array<double, 4>> Bounds;
  /// Borders of pixels are at multiples of the resolution; else the first ones at the bounds.
  bool Aligned = true;
  std::optional<RasterGrid> Like; ///< that of another raster, instead of all others
};

/// The grid that covers the bounds (xmin, xmax, ymin, ymax, of the points). Throws
/// std::runtime_error if they are not finite, or the raster would have too many rows or columns.
VTKTIPPIO_EXPORT RasterGrid makeRasterGrid(
  const RasterRequest& request, const std::array<double, 4>& pointBounds);

} // namespace tipp

#endif
