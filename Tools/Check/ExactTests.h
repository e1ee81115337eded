// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactTests_h
#define tippExactTests_h

namespace tipp
{
namespace check
{

/// The checker's own point type and tests: it shares no code with the algorithm that it checks.
struct Position
{
  double x;
  double y;
};

inline bool isBefore(Position a, Position b)
{
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if they are collinear.
int turn(Position a, Position b, Position c);

/// +1 if d lies inside the circle of the counter-clockwise a, b, c, -1 outside, 0 on it.
int inCircle(Position a, Position b, Position c, Position d);

} // namespace check
} // namespace tipp

#endif
