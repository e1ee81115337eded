// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExtent_h
#define tippExtent_h

#include "Kernel/Lanes.h"
#include "Predicates/Point2.h"

#include <array>
#include <cstddef>
#include <limits>

namespace tipp
{

/// The smallest and the largest coordinates of points; NaN is ignored.
struct Extent
{
  Pair Low;
  Pair High;
  bool AllFinite;
};

/// Returns the extent of `count` points; for none, Low is infinity and High is minus infinity.
inline Extent extentOf(const Point2* points, std::size_t count)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::size_t lanes = 4; // independent chains of comparisons
  const Pair none{ infinity, infinity };
  std::array<Pair, lanes> low;
  std::array<Pair, lanes> high;
  std::array<PairMask, lanes> finite;
  low.fill(none);
  high.fill(-none);
  finite.fill(PairMask{ -1, -1 });
  const auto add = [&](std::size_t lane, Point2 point)
  {
    const Pair p{ point.x, point.y };
    low[lane] = lower(p, low[lane]);
    high[lane] = higher(p, high[lane]);
    finite[lane] &= magnitude(p) < none;
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      add(lane, points[i + lane]);
    }
  }
  for (; i < count; ++i)
  {
    add(0, points[i]);
  }
  for (std::size_t lane = 1; lane < lanes; ++lane)
  {
    low[0] = lower(low[lane], low[0]);
    high[0] = higher(high[lane], high[0]);
    finite[0] &= finite[lane];
  }
  return { low[0], high[0], bitsOf(finite[0]) == 3 };
}

} // namespace tipp

#endif
