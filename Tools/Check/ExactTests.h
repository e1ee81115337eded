// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactTests_h
#define tippExactTests_h

#include <cstdint>
#include <vector>

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
namespace check
{

struct DirectedEdge
{
  std::int64_t From;
  std::int64_t To;
};

/// Counts the edges that keep `edges` from being one closed convex counter-clockwise chain,
/// collinear runs allowed; 0 if they are one. Sorts the edges by From.
std::int64_t countHullFaults(const std::vector<double>& xy, std::vector<DirectedEdge>& edges);

/// Counts the edges that are not edges of the convex hull of the finite points, where all points on
/// the hull are vertices of it.
std::int64_t countOffHull(const std::vector<double>& xy, const std::vector<DirectedEdge>& edges);

} // namespace check
} // namespace tipp

#endif
