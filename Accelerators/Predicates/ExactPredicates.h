// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactPredicates_h
#define tippExactPredicates_h

#include "Predicates/Geometry.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cmath>
#include <cstddef>

namespace tipp
{

/// Returns orientation() by exact arithmetic, for callers whose own filter has failed.
VTKTIPPACCELERATORS_EXPORT int orientationExact(Point2 a, Point2 b, Point2 c);

/// The error of left - right, where both are products of two differences of coordinates, in
/// doubles. Infinite or NaN after an overflow.
inline double orientationErrorBound(double left, double right)
{
  // (3 + 16 e) e, e = 2^-53: Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997,
  // section 4.3.
  constexpr double relative = 3.3306690738754716e-16;
  // The bound assumes no underflow. Three roundings below the normal range (two products, the
  // bound) add at most 2^-1075 each; a difference never underflows.
  constexpr double absolute = 1e-300;
  return relative * (std::fabs(left) + std::fabs(right)) + absolute;
}

/// Exact for all finite coordinates: +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if
/// collinear.
inline int orientation(Point2 a, Point2 b, Point2 c)
{
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = orientationErrorBound(left, right);
  // After an overflow the bound is infinite or NaN, and the comparison is false. The sign is found
  // without a branch, which would be mispredicted half of the time.
  return std::fabs(determinant) > bound ? signOf(determinant) : orientationExact(a, b, c);
}

/// Whether the segments ab and cd cross at one point in the interior of both. Exact for all finite
/// coordinates.
inline bool crossProperly(Point2 a, Point2 b, Point2 c, Point2 d)
{
  const int sideOfC = orientation(a, b, c);
  if (sideOfC == 0 || orientation(a, b, d) != -sideOfC)
  {
    return false;
  }
  const int sideOfA = orientation(c, d, a);
  return sideOfA != 0 && orientation(c, d, b) == -sideOfA;
}

/// The crossing point of ab and cd, which must cross properly. Each coordinate is rounded to the
/// nearest double, ties to even; so the point lies in the bounding boxes of both.
VTKTIPPACCELERATORS_EXPORT Point2 crossingPoint(Point2 a, Point2 b, Point2 c, Point2 d);

/// The in-circle determinant in doubles, and the sum of its three lifts, which bounds its error.
struct InCircleValue
{
  double determinant;
  double lifts;
};

/// Evaluates the in-circle determinant of p and the triangle a, b, c without error control.
inline InCircleValue inCircleValue(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const auto [ax, ay] = a - p;
  const auto [bx, by] = b - p;
  const auto [cx, cy] = c - p;
  const double aLift = ax * ax + ay * ay;
  const double bLift = bx * bx + by * by;
  const double cLift = cx * cx + cy * cy;
  const double determinant =
    aLift * (bx * cy - cx * by) + bLift * (cx * ay - ax * cy) + cLift * (ax * by - bx * ay);
  return { determinant, aLift + bLift + cLift };
}

/// An upper bound of the determinant's error for any coordinates; infinite or NaN after overflow.
//
// Shewchuk 1997, section 4.4: |error| <= (10 + 96 e) e P, e = 2^-53, P the permanent, where P sums
// lift(a) (|bx cy| + |cx by|) and its like. By Cauchy-Schwarz |bx cy| + |cx by| <= |b| |c|
// <= (lift b + lift c) / 2, so P <= ab + bc + ca in lifts <= S^2 / 3 for their sum S. The third of
// 10 e is 3.3334 e; 3.4 e leaves 2 % for the rounding of S and of this product.
//
// Underflow: lifts and crosses are off by at most u = 2^-1074, the determinant by at most 2 u S + 2
// u. For S > 1 the spare 0.06 e S^2 is more; otherwise, and where S^2 underflows, 1e-300 is.
//
// Overflow: every partial sum of the determinant is at most S^2 / 3, so S * S is infinite first.
inline double inCircleErrorBound(double lifts)
{
  constexpr double relative = 3.4 * 0x1p-53;
  constexpr double absolute = 1e-300;
  return relative * (lifts * lifts) + absolute;
}

/// Returns inCircle() by exact arithmetic, for callers whose own filter has failed.
VTKTIPPACCELERATORS_EXPORT int inCircleExact(Point2 a, Point2 b, Point2 c, Point2 p);

/// The position of p relative to the circle through a, b, c, which must turn counter-clockwise.
/// Exact for all finite coordinates: +1 strictly inside, 0 on the circle, -1 outside.
inline int inCircle(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const InCircleValue value = inCircleValue(a, b, c, p);
  const double bound = inCircleErrorBound(value.lifts);
  return std::fabs(value.determinant) > bound ? signOf(value.determinant)
                                              : inCircleExact(a, b, c, p);
}

/// The tie rule alone: whether p counts as inside if it lies on the circle of a, b, c.
//
// Devillers and Teillaud, Perturbations for Delaunay and weighted Delaunay 3D triangulations, 2011:
// lift the lexicographically largest of the four points by the largest infinitesimal. Then p is
// outside if it is that point; otherwise the result is the orientation of the triangle with p
// instead of that corner. Three distinct points of a circle are not collinear, so one step
// decides. A p equal to a corner is outside.
inline bool tieIsInside(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const Point2 ab = lexicographicLess(a, b) ? b : a;
  const Point2 largest = lexicographicLess(ab, c) ? c : ab;
  if (!lexicographicLess(p, largest))
  {
    return false;
  }
  return orientation(largest == a ? p : a, largest == b ? p : b, largest == c ? p : c) > 0;
}

/// Exact in-circle test with ties broken by coordinates alone, as CGAL's Delaunay_triangulation_2
/// does: it makes the triangulation of a point set unique.
inline bool inCirclePerturbed(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const int side = inCircle(a, b, c, p);
  return side != 0 ? side > 0 : tieIsInside(a, b, c, p);
}

/// The cheapest arithmetic in which the predicates are exact for all points of a set.
enum class Exactness
{
  Doubles, ///< differences below 2^12 units: plain double arithmetic has no rounding error
  Int128,  ///< below 2^31 units
  Int256,  ///< below 2^63 units
  General  ///< none of these: the stateless exact predicates
};

/// The common binary grid of a point set: the lowest digit of any difference of two coordinates
/// (the unit), and the set's extent in units. After one pass over all points, exact predicates on
/// these points need not inspect exponents. Compute it lazily, when a floating-point filter first
/// fails.
class VTKTIPPACCELERATORS_EXPORT CoordinateGrid
{
public:
  /// Analyses all points, which must be finite. About 4 ns per point; stops early at General.
  void analyse(const Point2* points, std::size_t count);

  Exactness exactness() const { return this->Mode; }

  /// Exact, without a filter, for points that were analysed: +1 if a, b, c turn counter-clockwise,
  /// -1 if clockwise, 0 if collinear.
  int orientation(Point2 a, Point2 b, Point2 c) const;

  /// Exact, without a filter, for points that were analysed; a, b, c must turn counter-clockwise:
  /// +1 if p is strictly inside their circle, 0 on it, -1 outside.
  int inCircle(Point2 a, Point2 b, Point2 c, Point2 p) const;

private:
  Exactness Mode = Exactness::General;
  double Scale = 1.0; // 1 / unit, a power of two
};

} // namespace tipp

#endif
