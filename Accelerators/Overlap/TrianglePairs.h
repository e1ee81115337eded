// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTrianglePairs_h
#define tippTrianglePairs_h

#include "Overlap/ConvexPart.h"
#include "Overlap/PlaneTriangles.h"
#include "Predicates/ExactPredicates.h"

#include <cmath>

namespace tipp
{

/// Values of the corners of the common part of two triangles: three distances from the edges of the
/// first one, times their lengths, then, if there are six, the barycentric weights of the corners
/// of the second one.
template <int Values>
using CommonPart = ConvexPart<Values>;

/// Twice the area of the triangle a, b, p, negative if it is clockwise. The sign is exact, and the
/// result is 0 only if the points are on one line.
inline double signedSide(Point2 a, Point2 b, Point2 p)
{
  const double left = (b.x - a.x) * (p.y - a.y);
  const double right = (b.y - a.y) * (p.x - a.x);
  const double determinant = left - right;
  if (std::fabs(determinant) > orientationErrorBound(left, right))
  {
    return determinant;
  }
  const int sign = orientationExact(b, p, a);
  constexpr double least = 1e-300;
  return sign == 0 ? 0 : std::copysign(std::fmax(std::fabs(determinant), least), sign);
}

/// Whether all corners of a triangle are certainly beyond one edge of another one. May return false
/// if they are.
inline bool isBeyond(const PlaneTriangle& edges, const PlaneTriangle& corners)
{
  for (int k = 0; k < 3; ++k)
  {
    const Point2 a = edges.At[k];
    const Point2 along = edges.At[(k + 1) % 3] - a;
    int beyond = 0;
    for (int i = 0; i < 3; ++i)
    {
      const double left = along.x * (corners.At[i].y - a.y);
      const double right = along.y * (corners.At[i].x - a.x);
      beyond += int(left - right < -orientationErrorBound(left, right));
    }
    if (beyond == 3)
    {
      return true;
    }
  }
  return false;
}

/// Whether the interiors of two counter-clockwise triangles have no common point. Exact: of two
/// convex polygons without a common interior point, an edge of one separates them.
inline bool areApart(const PlaneTriangle& first, const PlaneTriangle& second)
{
  const PlaneTriangle* const both[2] = { &first, &second };
  for (int which = 0; which < 2; ++which)
  {
    const PlaneTriangle& of = *both[which];
    const PlaneTriangle& other = *both[1 - which];
    for (int k = 0; k < 3; ++k)
    {
      bool isInside = false;
      for (int i = 0; i < 3 && !isInside; ++i)
      {
        isInside = orientation(of.At[k], of.At[(k + 1) % 3], other.At[i]) > 0;
      }
      if (!isInside)
      {
        return true;
      }
    }
  }
  return false;
}

/// Computes the common part of two counter-clockwise triangles, relative to the target's first
/// corner, in one of `parts`, to which it sets `part`. Returns its area; 0 if the interiors have no
/// common point, which is decided exactly. The area's error is a few roundings of the square of the
/// larger triangle's diameter.
template <int Values>
double intersect(const PlaneTriangle& target, const PlaneTriangle& source,
  CommonPart<Values> (&parts)[2], const CommonPart<Values>*& part)
{
  PartCorner<Values> corners[3];
  int cutting = 0; // a bit for each edge of the target that cuts the source
  for (int k = 0; k < 3; ++k)
  {
    int inside = 0;
    int outside = 0;
    for (int i = 0; i < 3; ++i)
    {
      const double side = signedSide(target.At[k], target.At[(k + 1) % 3], source.At[i]);
      corners[i].Value[k] = side;
      inside += int(side > 0);
      outside += int(side < 0);
    }
    if (inside == 0)
    {
      return 0;
    }
    cutting |= int(outside > 0) << k;
  }
  if (cutting != 0 && isBeyond(source, target))
  {
    return 0;
  }
  parts[0].clear();
  for (int i = 0; i < 3; ++i)
  {
    corners[i].At = source.At[i] - target.At[0];
    for (int k = 3; k < Values; ++k)
    {
      corners[i].Value[k] = source.cornerOf(i) == k - 3 ? 1 : 0;
    }
    parts[0].add(corners[i]);
  }
  int last = 0;
  for (int k = 0; k < 3; ++k)
  {
    if ((cutting & 1 << k) != 0)
    {
      parts[last].cut([k](const PartCorner<Values>& corner) { return corner.Value[k]; },
        [k](PartCorner<Values>& corner) { corner.Value[k] = 0; }, parts[1 - last], nullptr);
      last = 1 - last;
    }
  }
  part = &parts[last];
  const double area = part->area();
  // Only for a tiny part rounding can make one of triangles that touch.
  constexpr double tiny = 1e-12;
  const bool isSure =
    area > tiny * std::fabs(cross(source.At[1] - source.At[0], source.At[2] - source.At[0]));
  return isSure || (area > 0 && !areApart(target, source)) ? area : 0;
}

} // namespace tipp

#endif
