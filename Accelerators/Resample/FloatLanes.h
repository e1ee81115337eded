// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFloatLanes_h
#define tippFloatLanes_h

#include "Resample/Lanes.h"

#include <cstdint>
#include <cstring>

namespace tipp
{

/// Eight single-precision numbers in SIMD lanes, and eight masks or integers.
using FloatLanes = float __attribute__((vector_size(32)));
using FloatLaneInts = std::int32_t __attribute__((vector_size(32)));

constexpr int floatLaneCount = 8;

[[gnu::always_inline]] inline FloatLanes allFloats(float value)
{
  return FloatLanes{} + value;
}
/// The larger; b if one is NaN.
[[gnu::always_inline]] inline FloatLanes most(FloatLanes a, FloatLanes b)
{
  return a > b ? a : b;
}
/// The smaller; b if one is NaN.
[[gnu::always_inline]] inline FloatLanes least(FloatLanes a, FloatLanes b)
{
  return a < b ? a : b;
}
[[gnu::always_inline]] inline FloatLanes absolute(FloatLanes a)
{
  return FloatLanes(FloatLaneInts(a) & ~(FloatLaneInts{} + INT32_MIN));
}
[[gnu::always_inline]] inline FloatLaneInts toInts(FloatLanes a)
{
  return __builtin_convertvector(a, FloatLaneInts);
}
[[gnu::always_inline]] inline FloatLanes toFloats(FloatLaneInts a)
{
  return __builtin_convertvector(a, FloatLanes);
}

/// A bit for each lane.
[[gnu::always_inline]] inline unsigned floatLaneBits(FloatLaneInts truths)
{
#ifdef __SSE__
  using Half = float __attribute__((vector_size(16)));
  Half halves[2];
  std::memcpy(halves, &truths, sizeof truths);
  return unsigned(__builtin_ia32_movmskps(halves[0]) | __builtin_ia32_movmskps(halves[1]) << 4);
#else
  unsigned bits = 0;
  for (int lane = 0; lane < floatLaneCount; ++lane)
  {
    bits |= unsigned(truths[lane] & 1) << lane;
  }
  return bits;
#endif
}

/// Rounds four numbers to single precision.
[[gnu::always_inline]] inline void storeFloats(Lanes from, float (&to)[laneCount])
{
  using Half = float __attribute__((vector_size(16)));
  const Half floats = __builtin_convertvector(from, Half);
  std::memcpy(to, &floats, sizeof floats);
}

} // namespace tipp

#endif
