// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPoint3_h
#define tippPoint3_h

#include <array>

namespace tipp
{

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

} // namespace tipp

#endif
