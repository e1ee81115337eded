// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactTests_h
#define tippExactTests_h

#include <cmath>
#include <cstdint>
#include <vector>

namespace tipp
{
namespace check
{

/// The checker's own point type and tests. It shares no code with the algorithm that it checks.
struct Position
{
  double x;
  double y;
};

inline bool isFinite(Position p)
{
  return std::isfinite(p.x) && std::isfinite(p.y);
}

inline bool isSame(Position a, Position b)
{
  return a.x == b.x && a.y == b.y;
}

inline bool isBefore(Position a, Position b)
{
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// A point in space.
struct Position3
{
  double x;
  double y;
  double z;
};

inline bool operator==(const Position3& a, const Position3& b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// The lexicographic order.
inline bool operator<(const Position3& a, const Position3& b)
{
  return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

/// @name Signs
/// They are exact: by CGAL's kernel, and in the Python wheel by ExactNumber.
///@{
/// Returns +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if they are collinear.
int turn(Position a, Position b, Position c);

/// Returns +1 if d is inside the circle of the counter-clockwise a, b, c, -1 outside, 0 on it.
int inCircle(Position a, Position b, Position c, Position d);

/// Returns the sign of the determinant of b - a, c - a and d - a.
int turn(const Position3& a, const Position3& b, const Position3& c, const Position3& d);

/// Returns +1 if e is inside the sphere of a, b, c, d, whose turn() is +1, -1 outside, 0 on it.
int inSphere(const Position3& a, const Position3& b, const Position3& c, const Position3& d,
  const Position3& e);

bool areCollinear(const Position3& a, const Position3& b, const Position3& c);
///@}

/// Returns whether the edge from a to b, with c on its left and d on its right, is not locally
/// Delaunay. With `tieRule` also if all four are on a circle and the edge is the diagonal that the
/// rule forbids.
bool breaksDelaunay(Position a, Position b, Position c, Position d, bool tieRule);

/// A directed edge between two points, given by their indices in `xy`.
struct DirectedEdge
{
  std::int64_t From;
  std::int64_t To;
};

/// Returns 0 if the edges form one closed convex counter-clockwise chain, which may have collinear
/// edges; otherwise the number of edges that violate this. Sorts `edges` by From. `xy`: x and y of
/// each point.
std::int64_t countHullFaults(const std::vector<double>& xy, std::vector<DirectedEdge>& edges);

/// Returns the lower half of the convex hull of points in lexicographic order, including the points
/// on its edges. For the reverse order, returns the upper half.
template <typename Iterator>
std::vector<Position> halfHull(Iterator begin, Iterator end)
{
  std::vector<Position> chain;
  for (Iterator i = begin; i != end; ++i)
  {
    const Position p = *i;
    while (chain.size() > 1 && turn(chain[chain.size() - 2], chain.back(), p) < 0)
    {
      chain.pop_back();
    }
    chain.push_back(p);
  }
  return chain;
}

/// Counts the edges that are not edges of the convex hull of the finite points. All points on the
/// hull count as its vertices, so a hull edge joins two consecutive ones.
std::int64_t countOffHull(const std::vector<double>& xy, const std::vector<DirectedEdge>& edges);

} // namespace check
} // namespace tipp

#endif
