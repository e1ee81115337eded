// SPDX-License-Identifier: BSD-3-Clause
#include "ExactClipping.h"

#include <gmpxx.h>

#include <algorithm>

namespace oracle
{
namespace
{

using Point = std::array<mpq_class, 3>;
using Polygon = std::vector<Point>;

Point exact(const tipp::Point3& p)
{
  return { mpq_class(p.x), mpq_class(p.y), mpq_class(p.z) };
}

// The part of a closed convex polygon where sign * coordinate >= sign * bound.
Polygon clipped(const Polygon& polygon, std::size_t axis, int sign, const mpq_class& bound)
{
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Point& from = polygon[i];
    const Point& to = polygon[(i + 1) % polygon.size()];
    const mpq_class fromDepth = sign * (from[axis] - bound);
    const mpq_class toDepth = sign * (to[axis] - bound);
    if (fromDepth >= 0)
    {
      result.push_back(from);
    }
    if ((fromDepth > 0 && toDepth < 0) || (fromDepth < 0 && toDepth > 0))
    {
      const mpq_class part = fromDepth / (fromDepth - toDepth);
      Point crossing;
      for (std::size_t c = 0; c < 3; ++c)
      {
        crossing[c] = from[c] + part * (to[c] - from[c]);
      }
      crossing[axis] = bound;
      result.push_back(crossing);
    }
  }
  return result;
}

bool polygonMeetsBox(Polygon polygon, const tipp::Box3& box)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    polygon = clipped(polygon, axis, 1, mpq_class(box.Min[axis]));
    polygon = clipped(polygon, axis, -1, mpq_class(box.Max[axis]));
  }
  return !polygon.empty();
}

mpq_class determinant(const Point& a, const Point& b, const Point& c, const Point& d)
{
  const auto row = [&a](const Point& p) { return Point{ p[0] - a[0], p[1] - a[1], p[2] - a[2] }; };
  const Point u = row(b);
  const Point v = row(c);
  const Point w = row(d);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
    u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// Whether q is strictly inside. The caller tests the faces separately.
bool contains(const std::array<Point, 4>& p, const Point& q)
{
  const int whole = sgn(determinant(p[0], p[1], p[2], p[3]));
  return whole != 0 && sgn(determinant(q, p[1], p[2], p[3])) == whole &&
    sgn(determinant(p[0], q, p[2], p[3])) == whole &&
    sgn(determinant(p[0], p[1], q, p[3])) == whole &&
    sgn(determinant(p[0], p[1], p[2], q)) == whole;
}

} // namespace

bool triangleMeetsBox(const std::array<tipp::Point3, 3>& corners, const tipp::Box3& box)
{
  return polygonMeetsBox({ exact(corners[0]), exact(corners[1]), exact(corners[2]) }, box);
}

bool tetrahedronMeetsBox(const std::array<tipp::Point3, 4>& corners, const tipp::Box3& box)
{
  std::array<Point, 4> p;
  std::transform(corners.begin(), corners.end(), p.begin(), exact);
  return polygonMeetsBox({ p[0], p[1], p[2] }, box) || polygonMeetsBox({ p[0], p[1], p[3] }, box) ||
    polygonMeetsBox({ p[0], p[2], p[3] }, box) || polygonMeetsBox({ p[1], p[2], p[3] }, box) ||
    // The box meets no face, so it is either inside the tetrahedron or disjoint from it.
    contains(p, exact(box.Min));
}

int orientation3(const std::array<tipp::Point3, 4>& corners)
{
  return sgn(
    determinant(exact(corners[0]), exact(corners[1]), exact(corners[2]), exact(corners[3])));
}

} // namespace oracle
