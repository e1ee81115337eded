// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLanes_h
#define tippLanes_h

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

/// A bit for each negative lane, as in bitsOf(); unspecified for NaN.
inline unsigned signsOf(Pair a)
{
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(a));
#else
  return bitsOf(reinterpret_cast<PairMask>(a) >> 63);
#endif
}

/// The first lanes of both, or the second.
inline Pair low(Pair a, Pair b)
{
  return __builtin_shufflevector(a, b, 0, 2);
}
inline Pair high(Pair a, Pair b)
{
  return __builtin_shufflevector(a, b, 1, 3);
}

} // namespace tipp

#endif
