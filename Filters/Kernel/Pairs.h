// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPairs_h
#define tippPairs_h

#include "Predicates/Geometry.h"

#include <array>
#include <cstddef>
#include <limits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tipp
{

/// Two doubles side by side.
using Pair = double __attribute__((vector_size(16)));
using PairMask = long long __attribute__((vector_size(16)));

/// Loads two consecutive doubles at any alignment.
inline Pair pairAt(const double* lanes)
{
  using InMemory = double __attribute__((vector_size(16), aligned(8), may_alias));
  return *reinterpret_cast<const InMemory*>(lanes);
}

inline Pair magnitude(Pair a)
{
  return reinterpret_cast<Pair>(reinterpret_cast<PairMask>(a) & 0x7fffffffffffffffLL);
}

///@{
/// a < b ? a : b, and a > b ? a : b; b if one of them is NaN.
inline Pair lower(Pair a, Pair b)
{
#ifdef __SSE2__
  return _mm_min_pd(a, b);
#else
  return a < b ? a : b;
#endif
}
inline Pair higher(Pair a, Pair b)
{
#ifdef __SSE2__
  return _mm_max_pd(a, b);
#else
  return a > b ? a : b;
#endif
}
///@}

/// The mask as bits: bit 0 for the first lane, bit 1 for the second.
inline unsigned bitsOf(PairMask mask)
{
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
  return static_cast<unsigned>(mask[0] & 1) | static_cast<unsigned>(mask[1] & 2);
#endif
}

/// Like bitsOf(), with a bit set for each negative lane; unspecified for NaN.
inline unsigned signsOf(Pair a)
{
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(a));
#else
  return bitsOf(reinterpret_cast<PairMask>(a) >> 63);
#endif
}

/// Combines the first lanes of two pairs, or the second lanes.
inline Pair low(Pair a, Pair b)
{
  return __builtin_shufflevector(a, b, 0, 2);
}
inline Pair high(Pair a, Pair b)
{
  return __builtin_shufflevector(a, b, 1, 3);
}

/// The bounding box of points, and whether all are finite; NaN is ignored.
struct Extent
{
  Box2 Bounds;
  bool AllFinite;
};

/// Returns the extent of `count` points; for none, the box is empty.
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
  return { { { low[0][0], low[0][1] }, { high[0][0], high[0][1] } }, bitsOf(finite[0]) == 3 };
}

} // namespace tipp

#endif
