// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVectors_h
#define tippVectors_h

#include "Predicates/Geometry.h"

namespace tipp
{

/// @file
/// Products of vectors, rounded; ExactPredicates.h has exact signs.

inline double dot(const Point3& u, const Point3& v)
{
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

inline Point3 cross(const Point3& u, const Point3& v)
{
  return { u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x };
}

/// Returns the z of the cross product of vectors in the plane: positive for a turn to the left.
inline double cross(Point2 u, Point2 v)
{
  return u.x * v.y - u.y * v.x;
}

} // namespace tipp

#endif
