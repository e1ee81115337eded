// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/CellKey.h"

#include "Predicates/ExactPredicates3.h"

namespace tipp
{
namespace
{

/// The set of moves, a bit each, to the inner side of an edge or face. x, y and z are the signs of
/// its inner normal's components; the first nonzero one decides.
unsigned movesInside(int x, int y, int z)
{
  // The moves that are not mirrored along the deciding axis.
  const unsigned upward = x != 0 ? 0x55u : y != 0 ? 0x33u : 0x0fu;
  return (x != 0 ? x : y != 0 ? y : z) > 0 ? upward : ~upward;
}

int firstOf(unsigned moves)
{
  return moves != 0 ? __builtin_ctz(moves) : closedOnly;
}

} // namespace

int moveRank(const Point2 (&corners)[3], Point2 sample)
{
  unsigned moves = 0x0f;
  const int turn = orientation(corners[0], corners[1], corners[2]);
  for (int i = 0; i < 3; ++i)
  {
    const Point2 a = corners[i];
    const Point2 b = corners[(i + 1) % 3];
    const int side = orientation(a, b, sample);
    if (side == -turn)
    {
      return nearOnly;
    }
    if (side == 0)
    {
      moves &= movesInside(turn * signOf(a.y - b.y), turn * signOf(b.x - a.x), 0);
    }
  }
  return firstOf(moves);
}

int moveRank(const Point3 (&corners)[4], Point3 sample)
{
  constexpr int faces[4][3] = { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 2 } };
  unsigned moves = 0xff;
  const int side = orientation3(corners[0], corners[1], corners[2], corners[3]);
  for (const int(&face)[3] : faces)
  {
    const Point3 a = corners[face[0]];
    const Point3 b = corners[face[1]];
    const Point3 c = corners[face[2]];
    if (orientation3(a, b, c, sample) == 0)
    {
      moves &= movesInside(side * orientation({ a.y, a.z }, { b.y, b.z }, { c.y, c.z }),
        side * orientation({ a.z, a.x }, { b.z, b.x }, { c.z, c.x }),
        side * orientation({ a.x, a.y }, { b.x, b.y }, { c.x, c.y }));
    }
  }
  return firstOf(moves);
}

} // namespace tipp
