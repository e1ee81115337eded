// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOrientation3_h
#define tippOrientation3_h

#include "Predicates/Point3.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cmath>

namespace tipp
{

/// The same as orientation3(), straight by exact arithmetic: for callers whose own filter has
/// failed.
VTKTIPPACCELERATORS_EXPORT int orientation3Exact(Point3 a, Point3 b, Point3 c, Point3 d);

/// Exact for all finite coordinates: the sign of the determinant of b - a, c - a, d - a. It is +1
/// if d lies on the side of the plane abc from which a, b, c turn counter-clockwise.
inline int orientation3(Point3 a, Point3 b, Point3 c, Point3 d)
{
  // (7 + 56 e) e, e = 2^-53: Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997,
  // section 4.3; here with a margin, and a term for underflow.
  constexpr double relative = 8e-16;
  constexpr double absolute = 1e-290;
  const double bx = b.x - a.x;
  const double by = b.y - a.y;
  const double bz = b.z - a.z;
  const double cx = c.x - a.x;
  const double cy = c.y - a.y;
  const double cz = c.z - a.z;
  const double dx = d.x - a.x;
  const double dy = d.y - a.y;
  const double dz = d.z - a.z;
  const double xy = bx * cy;
  const double yx = by * cx;
  const double yz = by * cz;
  const double zy = bz * cy;
  const double zx = bz * cx;
  const double xz = bx * cz;
  const double determinant = dx * (yz - zy) + dy * (zx - xz) + dz * (xy - yx);
  const double permanent = std::fabs(dx) * (std::fabs(yz) + std::fabs(zy)) +
    std::fabs(dy) * (std::fabs(zx) + std::fabs(xz)) +
    std::fabs(dz) * (std::fabs(xy) + std::fabs(yx));
  // A factor below 2^-500 may have lost digits that a large third one would bring back.
  const double largest =
    std::fmax(std::fmax(std::fabs(dx), std::fabs(dy)), std::fmax(std::fabs(dz), 1.0));
  const double bound = relative * permanent + absolute * largest;
  if (determinant > bound)
  {
    return 1;
  }
  if (-determinant > bound)
  {
    return -1;
  }
  return orientation3Exact(a, b, c, d);
}

} // namespace tipp

#endif
