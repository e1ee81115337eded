// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNormalAxis_h
#define tippNormalAxis_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

namespace tipp
{

/// The coordinate axis (0, 1 or 2) in which the normal of the plane through three points, which
/// must not be collinear, is longest; of axes in which it is equally long the last one. Exact for
/// all finite coordinates, so the same for any three points of a plane. Projection along this axis
/// maps no two points of the plane to one.
VTKTIPPACCELERATORS_EXPORT int normalAxis(const Point3& a, const Point3& b, const Point3& c);

} // namespace tipp

#endif
