// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/CellBox.h"

#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <array>

namespace tipp
{
namespace
{

// A rectangle: the projection of a box along an axis.
struct Shadow
{
  Point2 Min;
  Point2 Max;
};

bool contains(const Shadow& box, Point2 p)
{
  return box.Min.x <= p.x && p.x <= box.Max.x && box.Min.y <= p.y && p.y <= box.Max.y;
}

// +1 or -1 if the rectangle lies strictly on that side of the directed line ab, else 0.
int strictSide(Point2 a, Point2 b, const Shadow& box)
{
  // The rectangle's extreme corners to the left and to the right of the line.
  const bool east = b.x > a.x;
  const bool north = b.y > a.y;
  const Point2 left = { north ? box.Min.x : box.Max.x, east ? box.Max.y : box.Min.y };
  const Point2 right = { north ? box.Max.x : box.Min.x, east ? box.Min.y : box.Max.y };
  if (orientation(a, b, right) > 0)
  {
    return 1;
  }
  return orientation(a, b, left) < 0 ? -1 : 0;
}

// Whether a line parallel to ab lies strictly between the rectangle and the points: the rectangle
// is strictly on one side of ab, and none of the other points is on that side.
template <std::size_t N>
bool edgeSeparates(Point2 a, Point2 b, const std::array<Point2, N>& others, const Shadow& box)
{
  const int side = strictSide(a, b, box);
  return side != 0 &&
    std::none_of(
      others.begin(), others.end(), [&](Point2 other) { return orientation(a, b, other) == side; });
}

// Tests the six edges of the tetrahedron, projected along one axis.
bool edgesSeparate(const std::array<Point2, 4>& p, const Shadow& box)
{
  return edgeSeparates<2>(p[0], p[1], { p[2], p[3] }, box) ||
    edgeSeparates<2>(p[0], p[2], { p[1], p[3] }, box) ||
    edgeSeparates<2>(p[0], p[3], { p[1], p[2] }, box) ||
    edgeSeparates<2>(p[1], p[2], { p[0], p[3] }, box) ||
    edgeSeparates<2>(p[1], p[3], { p[0], p[2] }, box) ||
    edgeSeparates<2>(p[2], p[3], { p[0], p[1] }, box);
}

// Whether the box lies strictly on one side of the plane of a, b, c, and d does not.
bool faceSeparates(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box)
{
  // The signs of the normal's components, and so the box's extreme corners along it.
  const int x = orientation({ a.y, a.z }, { b.y, b.z }, { c.y, c.z });
  const int y = orientation({ a.z, a.x }, { b.z, b.x }, { c.z, c.x });
  const int z = orientation({ a.x, a.y }, { b.x, b.y }, { c.x, c.y });
  const Point3 highest = { x > 0 ? box.Max[0] : box.Min[0], y > 0 ? box.Max[1] : box.Min[1],
    z > 0 ? box.Max[2] : box.Min[2] };
  const Point3 lowest = { x > 0 ? box.Min[0] : box.Max[0], y > 0 ? box.Min[1] : box.Max[1],
    z > 0 ? box.Min[2] : box.Max[2] };
  int side = orientation3(a, b, c, lowest) > 0 ? 1 : 0;
  if (side == 0 && orientation3(a, b, c, highest) < 0)
  {
    side = -1;
  }
  return side != 0 && orientation3(a, b, c, d) != side;
}

template <std::size_t N>
bool apartAlongAxis(const std::array<double, N>& values, double low, double high)
{
  return *std::max_element(values.begin(), values.end()) < low ||
    *std::min_element(values.begin(), values.end()) > high;
}

bool boundsMeet(const std::array<Point3, 4>& p, const Box3& box)
{
  return !apartAlongAxis<4>({ p[0].x, p[1].x, p[2].x, p[3].x }, box.Min[0], box.Max[0]) &&
    !apartAlongAxis<4>({ p[0].y, p[1].y, p[2].y, p[3].y }, box.Min[1], box.Max[1]) &&
    !apartAlongAxis<4>({ p[0].z, p[1].z, p[2].z, p[3].z }, box.Min[2], box.Max[2]);
}

bool contains(const Box3& box, const Point3& p)
{
  return box.Min[0] <= p.x && p.x <= box.Max[0] && box.Min[1] <= p.y && p.y <= box.Max[1] &&
    box.Min[2] <= p.z && p.z <= box.Max[2];
}

} // namespace

bool triangleMeetsBox(Point2 a, Point2 b, Point2 c, const Box3& box)
{
  const Shadow shadow = { { box.Min[0], box.Min[1] }, { box.Max[0], box.Max[1] } };
  if (contains(shadow, a) || contains(shadow, b) || contains(shadow, c))
  {
    return true;
  }
  return !apartAlongAxis<3>({ a.x, b.x, c.x }, box.Min[0], box.Max[0]) &&
    !apartAlongAxis<3>({ a.y, b.y, c.y }, box.Min[1], box.Max[1]) &&
    !edgeSeparates<1>(a, b, { c }, shadow) && !edgeSeparates<1>(b, c, { a }, shadow) &&
    !edgeSeparates<1>(c, a, { b }, shadow);
}

bool tetrahedronMeetsBox(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box)
{
  const std::array<Point3, 4> p = { a, b, c, d };
  if (std::any_of(p.begin(), p.end(), [&](const Point3& corner) { return contains(box, corner); }))
  {
    return true;
  }
  if (!boundsMeet(p, box) || faceSeparates(a, b, c, d, box) || faceSeparates(a, b, d, c, box) ||
    faceSeparates(a, c, d, b, box) || faceSeparates(b, c, d, a, box))
  {
    return false;
  }
  const auto seen = [&](auto first, auto second)
  {
    return std::array<Point2, 4>{ { { a.*first, a.*second }, { b.*first, b.*second },
      { c.*first, c.*second }, { d.*first, d.*second } } };
  };
  const auto shadow = [&](std::size_t first, std::size_t second) {
    return Shadow{ { box.Min[first], box.Min[second] }, { box.Max[first], box.Max[second] } };
  };
  return !edgesSeparate(seen(&Point3::x, &Point3::y), shadow(0, 1)) &&
    !edgesSeparate(seen(&Point3::y, &Point3::z), shadow(1, 2)) &&
    !edgesSeparate(seen(&Point3::z, &Point3::x), shadow(2, 0));
}

} // namespace tipp
