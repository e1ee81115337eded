// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIntegerSigns_h
#define tippIntegerSigns_h

#include "Predicates/Int128.h"
#include "Predicates/Int256.h"

#include <cstdint>

// Signs of the two determinants over integer differences, in the narrowest integers that hold them.
// The suffix is the number of binary digits of every difference: |difference| < 2^digits.
namespace tipp
{

template <typename Integer>
int signOf(Integer value)
{
  return (value > 0) - (value < 0);
}

/// Sign of u x v. Each product is below 2^2k, their difference below 2^(2k+1): 31 digits fit 64
/// bits.
inline int orientationSign31(std::int64_t ux, std::int64_t uy, std::int64_t vx, std::int64_t vy)
{
  return signOf(ux * vy - uy * vx);
}

/// The same with 63 digits, below 2^127.
inline int orientationSign63(std::int64_t ux, std::int64_t uy, std::int64_t vx, std::int64_t vy)
{
  return signOf(static_cast<Int128>(ux) * vy - static_cast<Int128>(uy) * vx);
}

/// Differences of the three triangle corners to the query point.
struct InCircleIntegers
{
  std::int64_t ax, ay, bx, by, cx, cy;
};

// Why k digits need 4k+4 bits, sign included. A lift is at most 2 (2^k - 1)^2 < 2^(2k+1), and by
// Cauchy-Schwarz so is the cross product of two differences, its two products each below 2^2k.
// The crosses' signs: if two terms share a sign, the determinant lies below 2 * 2^(4k+2) =
// 2^(4k+3). If all three do, it is at most (largest lift) * |sum of crosses|, and that sum is twice
// the area of a triangle in a square of side below 2^(k+1): below 2^(2k+1) * 2^(2k+2) = 2^(4k+3)
// again. Partial sums may be larger; they wrap, which does not change a last sum that fits.

/// Sign of the in-circle determinant for 31 digits: lifts and crosses below 2^63, sum below 2^127.
inline int inCircleSign31(const InCircleIntegers& d)
{
  const auto term = [](std::int64_t x, std::int64_t y, std::int64_t cross)
  { return static_cast<UInt128>(static_cast<Int128>(x * x + y * y) * cross); };
  const UInt128 sum = term(d.ax, d.ay, d.bx * d.cy - d.by * d.cx) +
    term(d.bx, d.by, d.cx * d.ay - d.cy * d.ax) + term(d.cx, d.cy, d.ax * d.by - d.ay * d.bx);
  return signOf(static_cast<Int128>(sum));
}

/// Sign of the in-circle determinant for 63 digits: lifts and crosses below 2^127, sum below 2^255.
inline int inCircleSign63(const InCircleIntegers& d)
{
  const auto times = [](std::int64_t x, std::int64_t y) { return static_cast<Int128>(x) * y; };
  const auto term = [&](std::int64_t x, std::int64_t y, Int128 cross)
  { return Int256::product(times(x, x) + times(y, y), cross); };
  Int256 sum = term(d.ax, d.ay, times(d.bx, d.cy) - times(d.by, d.cx));
  sum += term(d.bx, d.by, times(d.cx, d.ay) - times(d.cy, d.ax));
  sum += term(d.cx, d.cy, times(d.ax, d.by) - times(d.ay, d.bx));
  return sum.sign();
}

} // namespace tipp

#endif
