// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDegenerateInput_h
#define tippDegenerateInput_h

#include "Predicates/Box2.h"
#include "Predicates/Point2.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"

#include <vector>

namespace tipp
{

/// Very small or very large coordinates, products of which would under- or overflow, times a power
/// of two that brings them near 1: exact, and the filters work again. The points as they are where
/// that would lose digits (a wide range of magnitudes) or is not needed.
PointsView withModerateMagnitude(PointsView points, const Box2& bounds);

/// Whether points that come one by one lie on one line.
class CollinearityTest
{
public:
  /// False as soon as three finite points do not; then it always is.
  bool add(Point2 p);

  /// Two of the points, or fewer, that lie on the line; instead of all, where all do.
  std::vector<Point2> line() const { return { this->Line, this->Line + this->Found }; }

private:
  bool Holds = true;
  std::size_t Found = 0; ///< distinct points, at most two
  Point2 Line[2]{};
};

/// True if the finite points lie on one line, or there are fewer than three. Looks at no more
/// points than it needs.
bool areCollinear(PointsView points);

/// The duplicates of finite points, by sorting: for input that is not triangulated.
std::vector<Duplicate> sortOutDuplicates(PointsView points);

} // namespace tipp

#endif
