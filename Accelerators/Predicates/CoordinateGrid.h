// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCoordinateGrid_h
#define tippCoordinateGrid_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>

namespace tipp
{

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
