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

/// Of two doubles that lie side by side in memory, anywhere.
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
/// a < b ? a : b, and a > b ? a : b: with a NaN among them, b.
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

/// Bit 0 for the first lane, bit 1 for the second.
inline unsigned bitsOf(PairMask mask)
{
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
  return static_cast<unsigned>(mask[0] & 1) | static_cast<unsigned>(mask[1] & 2);
#endif
}

/// The same for the lanes that are negative; any bit for one that is NaN.
inline unsigned signsOf(Pair a)
{
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_pd(a));
#else
  return bitsOf(reinterpret_cast<PairMask>(a) >> 63);
#endif
}

/// The first lanes of both, and the second.
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
