// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Containment.h"

#include "Predicates/Orientation.h"
#include "Predicates/Orientation3.h"

#include <utility>

namespace tipp
{
namespace
{

/// Signs of the inner normal of an edge or face that the sample lies on.
struct Normal
{
  int X;
  int Y;
  int Z;

  bool admits(int move) const
  {
    if (this->X != 0)
    {
      return (this->X > 0) == ((move & 1) == 0);
    }
    if (this->Y != 0)
    {
      return (this->Y > 0) == ((move & 2) == 0);
    }
    return (this->Z > 0) == ((move & 4) == 0);
  }
};

int firstMove(const Normal* normals, int count, int moves)
{
  for (int move = 0; move < moves; ++move)
  {
    bool admitted = true;
    for (int i = 0; i < count; ++i)
    {
      admitted = admitted && normals[i].admits(move);
    }
    if (admitted)
    {
      return move;
    }
  }
  return closedOnly;
}

int sign(double low, double high)
{
  return (high > low) - (high < low);
}

} // namespace

int moveRank(const Point2 (&corners)[3], Point2 sample)
{
  Normal normals[3];
  int touched = 0;
  const int turn = orientation(corners[0], corners[1], corners[2]);
  for (int i = 0; i < 3; ++i)
  {
    const Point2 a = corners[i];
    const Point2 b = corners[(i + 1) % 3];
    if (orientation(a, b, sample) == 0)
    {
      normals[touched++] = { turn * sign(b.y, a.y), turn * sign(a.x, b.x), 0 };
    }
  }
  return firstMove(normals, touched, 4);
}

int moveRank(const Point3 (&corners)[4], Point3 sample)
{
  constexpr int faces[4][3] = { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 2 } };
  Normal normals[4];
  int touched = 0;
  const int side = orientation3(corners[0], corners[1], corners[2], corners[3]);
  for (const int(&face)[3] : faces)
  {
    const Point3 a = corners[face[0]];
    const Point3 b = corners[face[1]];
    const Point3 c = corners[face[2]];
    if (orientation3(a, b, c, sample) == 0)
    {
      normals[touched++] = { side * orientation({ a.y, a.z }, { b.y, b.z }, { c.y, c.z }),
        side * orientation({ a.z, a.x }, { b.z, b.x }, { c.z, c.x }),
        side * orientation({ a.x, a.y }, { b.x, b.y }, { c.x, c.y }) };
    }
  }
  return firstMove(normals, touched, 8);
}

} // namespace tipp
