// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSegmentCrossing_h
#define tippSegmentCrossing_h

#include "Predicates/Orientation.h"
#include "Predicates/Point2.h"
#include "vtkTIPPAcceleratorsModule.h"

namespace tipp
{

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
