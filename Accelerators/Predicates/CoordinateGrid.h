// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCoordinateGrid_h
#define tippCoordinateGrid_h

#include "Predicates/Point2.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>

namespace tipp
{

/// The cheapest arithmetic in which the predicates are exact for every choice of points of a set.
enum class Exactness
{
  Doubles, ///< differences below 2^12 units: the plain evaluation in doubles has no error at all
  Int128,  ///< below 2^31 units
  Int256,  ///< below 2^63 units
  General  ///< none of these: the stateless exact predicates
};

/// The common binary grid of a point set: the lowest digit that any difference of two coordinates
/// has (the unit), and how many units the set spans. After one look at all points, exact predicates
/// over these points need no look at exponents. Meant to be analysed lazily, when a filter first
/// fails.
class VTKTIPPACCELERATORS_EXPORT CoordinateGrid
{
public:
  /// Looks at all points, which must be finite. About 4 ns a point; stops early at General.
  void analyse(const Point2* points, std::size_t count);

  Exactness exactness() const { return this->Mode; }

  /// Exact, without a filter in front, for points that were analysed: +1 if a, b, c turn
  /// counter-clockwise, -1 if clockwise, 0 if collinear.
  int orientation(Point2 a, Point2 b, Point2 c) const;

  /// Exact, without a filter in front, for points that were analysed; a, b, c turn
  /// counter-clockwise: +1 if p is strictly inside their circle, 0 on it, -1 outside.
  int inCircle(Point2 a, Point2 b, Point2 c, Point2 p) const;

private:
  Exactness Mode = Exactness::General;
  double Scale = 1.0; // units in 1, a power of two
};

} // namespace tipp

#endif
