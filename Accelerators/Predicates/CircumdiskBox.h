// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCircumdiskBox_h
#define tippCircumdiskBox_h

#include "Predicates/Circumdisk.h"

namespace tipp
{

/// Whether the closed circumdisk of a, b, c (counter-clockwise) and the closed box meet. Exact.
/// For one triangle and many boxes make a Circumdisk once.
inline bool circumdiskMeetsBox(Point2 a, Point2 b, Point2 c, const Box2& box)
{
  return Circumdisk(a, b, c).meets(box);
}

/// Whether the closed circumdisk of a, b, c (counter-clockwise) lies in the closed box. Exact.
inline bool circumdiskInsideBox(Point2 a, Point2 b, Point2 c, const Box2& box)
{
  return Circumdisk(a, b, c).inside(box);
}

} // namespace tipp

#endif
