// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOrientation_h
#define tippOrientation_h

#include "Predicates/Point2.h"
#include "vtkTIPPAcceleratorsModule.h"

namespace tipp
{

/// Exact: +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if collinear.
VTKTIPPACCELERATORS_EXPORT int orientation(Point2 a, Point2 b, Point2 c);

} // namespace tipp

#endif
