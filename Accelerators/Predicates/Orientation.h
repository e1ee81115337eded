// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOrientation_h
#define tippOrientation_h

#include "Predicates/Point2.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cmath>

namespace tipp
{

/// As orientation(), but directly in exact arithmetic: for callers whose own filter has failed.
VTKTIPPACCELERATORS_EXPORT int orientationExact(Point2 a, Point2 b, Point2 c);

/// Exact for all finite coordinates: +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if
/// collinear.
inline int orientation(Point2 a, Point2 b, Point2 c)
{
  // (3 + 16 e) e, e = 2^-53: Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997,
  // section 4.3.
  constexpr double relative = 3.3306690738754716e-16;
  // The bound assumes no underflow. Three roundings below the normal range (two products, the
  // bound) add at most 2^-1075 each; a difference never underflows.
  constexpr double absolute = 1e-300;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = relative * (std::fabs(left) + std::fabs(right)) + absolute;
  // After an overflow the bound is infinite or NaN, and both comparisons are false.
  if (determinant > bound)
  {
    return 1;
  }
  if (-determinant > bound)
  {
    return -1;
  }
  return orientationExact(a, b, c);
}

} // namespace tipp

#endif
