// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactDisk_h
#define tippExactDisk_h

#include "DelaunayOracle.h"
#include "Predicates/Geometry.h"

namespace tipp
{
namespace test
{

/// Whether (x, y) is inside (-1), on (0) or outside (1) the triangle's circumcircle. Computed in
/// rational arithmetic, as the sign of |centre - p|^2 - radius^2.
int sideOfDisk(const Coordinates& xy, const Triangle& triangle, double x, double y);

/// Whether the triangle's closed circumdisk meets the box, in rational arithmetic.
bool diskMeetsBox(const Coordinates& xy, const Triangle& triangle, const Box2& box);

/// The sign of the triangle's area, in rational arithmetic.
int orientationOf(const Coordinates& xy, const Triangle& triangle);

/// The triangles that belong to a partition: their closed circumdisk meets its box.
Triangles belonging(const Coordinates& xy, const Triangles& triangles, const Box2& box);

} // namespace test
} // namespace tipp

#endif
