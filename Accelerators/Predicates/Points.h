// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPoints_h
#define tippPoints_h

#include <array>
#include <cmath>

namespace tipp
{

/// +1, 0 or -1, without a branch.
template <typename Number>
int signOf(Number value)
{
  return (value > 0) - (value < 0);
}

/// A point, or a vector, in the plane.
struct Point2
{
  double x;
  double y;
};

inline bool operator==(Point2 a, Point2 b)
{
  return a.x == b.x && a.y == b.y;
}

inline Point2 operator-(Point2 a, Point2 b)
{
  return { a.x - b.x, a.y - b.y };
}

inline bool isFinite(Point2 p)
{
  return std::isfinite(p.x) && std::isfinite(p.y);
}

// The order that all tie rules of the project use.
inline bool lexicographicLess(Point2 a, Point2 b)
{
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// A closed axis-aligned box. Its bounds may be infinite; xmin <= xmax and ymin <= ymax.
struct Box2
{
  double xmin;
  double ymin;
  double xmax;
  double ymax;
};

/// A point, or a vector, in space.
struct Point3
{
  double x;
  double y;
  double z;
};

inline bool operator==(Point3 a, Point3 b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

inline Point3 operator-(const Point3& a, const Point3& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

inline bool isFinite(const Point3& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

inline bool lexicographicLess(Point3 a, Point3 b)
{
  return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

/// A closed axis-aligned box with finite bounds, Min[i] <= Max[i]; it may be flat. In 2D Min[2] =
/// Max[2] = 0.
struct Box3
{
  std::array<double, 3> Min = {};
  std::array<double, 3> Max = {};
};

/// Returns whether two closed boxes have a common point.
inline bool boxesMeet(const Box3& a, const Box3& b)
{
  return a.Min[0] <= b.Max[0] && b.Min[0] <= a.Max[0] && a.Min[1] <= b.Max[1] &&
    b.Min[1] <= a.Max[1] && a.Min[2] <= b.Max[2] && b.Min[2] <= a.Max[2];
}

} // namespace tipp

#endif
