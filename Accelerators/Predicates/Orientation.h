// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOrientation_h
#define tippOrientation_h

#include "Predicates/Point2.h"
#include "Predicates/Point3.h"
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

/// As orientation3(), but directly in exact arithmetic.
VTKTIPPACCELERATORS_EXPORT int orientation3Exact(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Exact for all finite coordinates: +1 if a, b, c turn counter-clockwise seen from d, -1 if
/// clockwise, 0 if the four are coplanar. It is the sign of ((b - a) x (c - a)) . (d - a), which is
/// +1 for a tetrahedron in VTK's order.
inline int orientation3(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  // (7 + 56 e) e, e = 2^-53: Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997,
  // section 4.3.
  constexpr double relative = 7.7715611723761e-16;
  const double ax = a.x - d.x;
  const double ay = a.y - d.y;
  const double az = a.z - d.z;
  const double bx = b.x - d.x;
  const double by = b.y - d.y;
  const double bz = b.z - d.z;
  const double cx = c.x - d.x;
  const double cy = c.y - d.y;
  const double cz = c.z - d.z;
  const double minus =
    az * (bx * cy - cx * by) + bz * (cx * ay - ax * cy) + cz * (ax * by - bx * ay);
  const double heights = std::fabs(az) + std::fabs(bz) + std::fabs(cz);
  const double permanent = std::fabs(az) * (std::fabs(bx * cy) + std::fabs(cx * by)) +
    std::fabs(bz) * (std::fabs(cx * ay) + std::fabs(ax * cy)) +
    std::fabs(cz) * (std::fabs(ax * by) + std::fabs(bx * ay));
  // A product below the normal range loses at most 2^-1075, which is multiplied by a height.
  const double bound = relative * permanent + 1e-300 * (1.0 + heights);
  // After an overflow the bound is infinite or NaN, and both comparisons are false.
  if (minus > bound)
  {
    return -1;
  }
  if (-minus > bound)
  {
    return 1;
  }
  return orientation3Exact(a, b, c, d);
}

/// Whether the segments ab and cd cross at one point in the interior of both. Exact for all finite
/// coordinates.
inline bool crossProperly(Point2 a, Point2 b, Point2 c, Point2 d)
{
  const int sideOfC = orientation(a, b, c);
  if (sideOfC == 0 || orientation(a, b, d) != -sideOfC)
  {
    return false;
  }
  const int sideOfA = orientation(c, d, a);
  return sideOfA != 0 && orientation(c, d, b) == -sideOfA;
}

/// The crossing point of ab and cd, which must cross properly. Each coordinate is rounded to the
/// nearest double, ties to even; so the point lies in the bounding boxes of both.
VTKTIPPACCELERATORS_EXPORT Point2 crossingPoint(Point2 a, Point2 b, Point2 c, Point2 d);

} // namespace tipp

#endif
