// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/RasterGrid.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tipp
{
namespace
{

struct GridAxis
{
  double Origin;
  std::int64_t Count;
};

/// The pixels that cover a range, at least one.
GridAxis coverRange(double low, double high, double size, bool aligned, const char* name)
{
  if (!(std::isfinite(low) && std::isfinite(high) && low <= high))
  {
    throw std::runtime_error(std::string("the bounds along ") + name +
      " are not a range: give finite bounds, the lower one first.");
  }
  // A range of whole pixels is not to get one more by a rounding.
  constexpr double slack = 1e-9;
  const double first = aligned ? std::floor(low / size + slack) : 0;
  const double origin = aligned ? first * size : low;
  const double count = std::ceil((high - origin) / size - slack);
  if (!(count < std::numeric_limits<std::int32_t>::max()))
  {
    throw std::runtime_error(
      std::string("the raster would have more than 2147483646 pixels along ") + name +
      ": give a larger resolution or smaller bounds.");
  }
  return { origin, count < 1 ? 1 : std::int64_t(count) };
}

} // namespace

RasterGrid makeRasterGrid(const RasterRequest& request, const std::array<double, 4>& pointBounds)
{
  if (request.Like)
  {
    return *request.Like;
  }
  const std::array<double, 4> bounds = request.Bounds.value_or(pointBounds);
  const double size = request.Resolution;
  const GridAxis x = coverRange(bounds[0], bounds[1], size, request.Aligned, "x");
  const GridAxis y = coverRange(bounds[2], bounds[3], size, request.Aligned, "y");
  return { x.Origin, y.Origin, { size, size }, x.Count, y.Count };
}

} // namespace tipp
