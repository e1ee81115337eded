// SPDX-License-Identifier: BSD-3-Clause
#include "ExactDisk.h"

#include <CGAL/Gmpq.h>

#include <algorithm>

namespace tipp
{
namespace test
{
namespace
{

using Rational = CGAL::Gmpq;

struct Disk
{
  Rational X, Y, SquaredRadius;
};

Rational coordinate(const Coordinates& xy, std::int64_t id, int axis)
{
  return Rational(xy[std::size_t(2 * id + axis)]);
}

/// Twice the triangle's area.
Rational area(const Coordinates& xy, const Triangle& t)
{
  const Rational x = coordinate(xy, t[0], 0);
  const Rational y = coordinate(xy, t[0], 1);
  return (coordinate(xy, t[1], 0) - x) * (coordinate(xy, t[2], 1) - y) -
    (coordinate(xy, t[1], 1) - y) * (coordinate(xy, t[2], 0) - x);
}

/// The centre c solves |c - a| = |c - b| = |c - d|: two equations, linear in c - a (Cramer's rule).
Disk circumdisk(const Coordinates& xy, const Triangle& t)
{
  const Rational ax = coordinate(xy, t[0], 0);
  const Rational ay = coordinate(xy, t[0], 1);
  const Rational bx = coordinate(xy, t[1], 0) - ax;
  const Rational by = coordinate(xy, t[1], 1) - ay;
  const Rational cx = coordinate(xy, t[2], 0) - ax;
  const Rational cy = coordinate(xy, t[2], 1) - ay;
  const Rational b2 = bx * bx + by * by;
  const Rational c2 = cx * cx + cy * cy;
  const Rational twice = Rational(2) * (bx * cy - by * cx);
  const Rational ux = (cy * b2 - by * c2) / twice;
  const Rational uy = (bx * c2 - cx * b2) / twice;
  return { ax + ux, ay + uy, ux * ux + uy * uy };
}

int sideOf(const Disk& disk, const Rational& x, const Rational& y)
{
  const Rational dx = x - disk.X;
  const Rational dy = y - disk.Y;
  return int(CGAL::sign(dx * dx + dy * dy - disk.SquaredRadius));
}

} // namespace

int sideOfDisk(const Coordinates& xy, const Triangle& triangle, double x, double y)
{
  return sideOf(circumdisk(xy, triangle), Rational(x), Rational(y));
}

bool diskMeetsBox(const Coordinates& xy, const Triangle& triangle, const Box2& box)
{
  const Disk disk = circumdisk(xy, triangle);
  // The point of the box closest to the centre.
  const Rational x = std::min(std::max(disk.X, Rational(box.Min.x)), Rational(box.Max.x));
  const Rational y = std::min(std::max(disk.Y, Rational(box.Min.y)), Rational(box.Max.y));
  return sideOf(disk, x, y) <= 0;
}

int orientationOf(const Coordinates& xy, const Triangle& triangle)
{
  return int(CGAL::sign(area(xy, triangle)));
}

Triangles belonging(const Coordinates& xy, const Triangles& triangles, const Box2& box)
{
  Triangles result;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(result),
    [&](const Triangle& t) { return diskMeetsBox(xy, t, box); });
  return result;
}

} // namespace test
} // namespace tipp
