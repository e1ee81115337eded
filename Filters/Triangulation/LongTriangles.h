// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLongTriangles_h
#define tippLongTriangles_h

#include "Predicates/Point2.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tipp
{

/// Whether a triangle has an edge longer than `length`. Does not depend on the order of the
/// corners.
inline bool hasLongEdge(Point2 a, Point2 b, Point2 c, double length)
{
  const auto isLong = [length](Point2 p, Point2 q)
  {
    const double dx = std::fabs(p.x - q.x);
    const double dy = std::fabs(p.y - q.y);
    // The sum decides for most edges, which are short. Squares could overflow.
    return dx + dy > length && std::hypot(dx, dy) > length;
  };
  return isLong(a, b) || isLong(b, c) || isLong(c, a);
}

/// Removes the triangles with an edge longer than `length`; the others keep their order. `ids` has
/// three per triangle; `pointOf` returns the coordinates of an id. Returns the number of triangles
/// left.
template <typename Id, typename PointOf>
std::size_t dropLongTriangles(Id* ids, std::size_t triangles, double length, const PointOf& pointOf)
{
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles; ++t)
  {
    const Id* const corners = ids + 3 * t;
    if (!hasLongEdge(pointOf(corners[0]), pointOf(corners[1]), pointOf(corners[2]), length))
    {
      std::copy_n(corners, 3, ids + 3 * kept++);
    }
  }
  return kept;
}

} // namespace tipp

#endif
