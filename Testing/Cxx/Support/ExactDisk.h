// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactDisk_h
#define tippExactDisk_h

#include "DelaunayOracle.h"

namespace tipp
{
namespace test
{

/// A closed box.
struct Box
{
  double XMin, YMin, XMax, YMax;
  bool holds(double x, double y) const { return XMin <= x && x <= XMax && YMin <= y && y <= YMax; }
};

/// In rational arithmetic: the sign of |centre - p|^2 - radius^2 for the circle through the
/// triangle's corners; -1 inside, 0 on it, 1 outside.
int sideOfDisk(const Coordinates& xy, const Triangle& triangle, double x, double y);

/// In rational arithmetic: does the closed circumdisk of the triangle meet the box?
bool diskMeetsBox(const Coordinates& xy, const Triangle& triangle, const Box& box);

/// In rational arithmetic: the sign of the triangle's area.
int orientationOf(const Coordinates& xy, const Triangle& triangle);

/// Those triangles whose closed circumdisk meets the box: they belong to it.
Triangles belonging(const Coordinates& xy, const Triangles& triangles, const Box& box);

} // namespace test
} // namespace tipp

#endif
