// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPoint2_h
#define tippPoint2_h

#include <cmath>

namespace tipp
{

struct Point2
{
  double x;
  double y;
};

inline bool operator==(Point2 a, Point2 b)
{
  return a.x == b.x && a.y == b.y;
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

} // namespace tipp

#endif
