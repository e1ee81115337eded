// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointSurvey_h
#define tippPointSurvey_h

#include "Predicates/Points.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The result of one pass over the points.
struct PointSurvey
{
  Box2 Bounds{ HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL }; ///< bounds of the finite points
  std::vector<std::int64_t> Rejected; ///< ids of points that are not finite; ascending
};

/// Returns the bounds of the finite points, and the indices of the others.
PointSurvey surveyPoints(PointsView points, int threads);

/// Returns about `count` finite points, evenly spaced in the input's order.
std::vector<Point2> samplePoints(PointsView points, std::size_t count);

/// Returns a power of two that scales coordinates whose largest magnitude is `largest` to about 1;
/// 1 if `largest` is 0 or between 2^-`moderate` and 2^`moderate`.
double moderateFactor(double largest, int moderate);
/// Returns whether multiplying this coordinate by the factor, a power of two, is exact.
inline bool isExactTimes(double x, double factor)
{
  return !std::isfinite(x) || x * factor / factor == x;
}

/// Scales very small or very large coordinates, whose products would underflow or overflow, by a
/// power of two that brings them near 1. This is exact, and the floating-point filters work again.
/// Returns the points unchanged if scaling would lose digits (a wide range of magnitudes) or is not
/// needed.
PointsView withModerateMagnitude(PointsView points, const Box2& bounds);

/// Tests whether points, added one at a time, are collinear.
class CollinearityTest
{
public:
  /// Adds a point. Returns false once three finite points added are not collinear.
  bool add(Point2 p);

  /// Returns up to two distinct points of the line; they stand for all points if all are collinear.
  std::vector<Point2> line() const { return { this->Line, this->Line + this->Found }; }

private:
  bool Holds = true;
  std::size_t Found = 0; ///< distinct points, at most two
  Point2 Line[2]{};
};

/// Whether the finite points are collinear or fewer than three. Stops at the first point off the
/// line.
bool areCollinear(PointsView points);

/// Returns the duplicates among the finite points, found by sorting, for input without triangles.
/// Ids are point indices.
std::vector<Duplicate> sortOutDuplicates(PointsView points);

} // namespace tipp

#endif
