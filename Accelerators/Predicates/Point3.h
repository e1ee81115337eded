// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPoint3_h
#define tippPoint3_h

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

} // namespace tipp

#endif
