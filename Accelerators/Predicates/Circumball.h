// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCircumball_h
#define tippCircumball_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tipp
{

/// The common part of Circumdisk (D = 2) and Circumball (D = 3): stores the centre and the radius
/// as intervals of doubles. If these leave a test undecided, arbitrary-precision integers decide.
template <std::size_t D>
class VTKTIPPACCELERATORS_EXPORT BallIntervals
{
protected:
  using Vector = std::array<double, D>;
  static constexpr double Infinity = std::numeric_limits<double>::infinity();

  /// Leaves the intervals infinite, so that every test uses exact arithmetic.
  explicit BallIntervals(const std::array<Vector, D + 1>& corners)
    : Corners(corners)
  {
    this->Low.fill(-Infinity);
    this->High.fill(Infinity);
  }

  /// Sets the intervals, unless the radius is too large (or NaN); then they stay infinite. `offset`
  /// leads from the first corner to the centre. Its entries are off by at most `errors`; the radius
  /// is off by at most their sum plus `roundings` * 2^-53 * radius.
  void setIntervals(const Vector& offset, const Vector& errors, double roundings)
  {
    constexpr double epsilon = 0x1p-53;
    double square = 0;
    double sum = 0;
    for (std::size_t k = 0; k < D; ++k)
    {
      square += offset[k] * offset[k];
      sum += errors[k];
    }
    const double radius = std::sqrt(square);
    const double radiusError = sum + roundings * epsilon * radius;
    // Within this limit squares of the radius and of similar distances are finite. False for NaN.
    if (!(radius + radiusError <= 1e150))
    {
      return;
    }
    for (std::size_t k = 0; k < D; ++k)
    {
      const double centre = this->Corners[0][k] + offset[k];
      const double error = errors[k] + epsilon * (4.0 * std::fabs(centre) + radius);
      this->Low[k] = centre - error;
      this->High[k] = centre + error;
    }
    this->Largest = radius + radiusError;
    this->Smallest = std::max(0.0, radius - radiusError);
    this->LargestSquare = this->Largest * this->Largest;
    this->SmallestSquare = this->Smallest * this->Smallest;
  }

  /// Whether the ball and the box [low, high] share a point.
  bool meetsBox(const Vector& low, const Vector& high) const
  {
    // Lower and upper bound of the distance from the centre to the nearest point of the box.
    double near = 0;
    double far = 0;
    for (std::size_t k = 0; k < D; ++k)
    {
      const double atLeast = gap(low[k] - this->High[k], this->Low[k] - high[k]);
      near += atLeast * atLeast;
    }
    if (near > this->LargestSquare)
    {
      return false;
    }
    for (std::size_t k = 0; k < D; ++k)
    {
      const double atMost = gap(low[k] - this->Low[k], this->High[k] - high[k]);
      far += atMost * atMost;
    }
    return far <= this->SmallestSquare || this->meetsExactly(low, high);
  }

  ///@{
  /// Exact, for boxes whose bounds may be infinite.
  bool meetsExactly(const Vector& low, const Vector& high) const;
  bool liesInsideExactly(const Vector& low, const Vector& high) const;
  ///@}

  std::array<Vector, D + 1> Corners;
  Vector Low;           // the centre lies between Low
  Vector High;          // and High
  double Smallest = -1; // interval of the radius
  double Largest = Infinity;
  double SmallestSquare = -1;      // interval of the squared radius,
  double LargestSquare = Infinity; // widened by the rounding of the squared distances in meetsBox()

private:
  static double gap(double before, double behind)
  {
    return std::max(std::max(before, behind), 0.0);
  }
};

extern template class BallIntervals<2>;
extern template class BallIntervals<3>;

/// The closed disk through the corners of a triangle, computed once and tested exactly against many
/// boxes. Corners must be finite and in counter-clockwise order.
class VTKTIPPACCELERATORS_EXPORT Circumdisk : BallIntervals<2>
{
public:
  Circumdisk(const Point2& a, const Point2& b, const Point2& c);

  /// Whether disk and box share a point; touching counts.
  bool meets(const Box2& box) const
  {
    return this->meetsBox({ box.xmin, box.ymin }, { box.xmax, box.ymax });
  }

  /// Whether the disk lies in the box; touching the box's border from inside counts.
  bool inside(const Box2& box) const
  {
    const Box2 outer = this->bounds();
    if (box.xmin <= outer.xmin && outer.xmax <= box.xmax && box.ymin <= outer.ymin &&
      outer.ymax <= box.ymax)
    {
      return true;
    }
    // The disk reaches or crosses each side of this box.
    const Box2 inner = { this->High[0] - this->Smallest, this->High[1] - this->Smallest,
      this->Low[0] + this->Smallest, this->Low[1] + this->Smallest };
    const bool reachesOut = inner.xmin < box.xmin || box.xmax < inner.xmax ||
      inner.ymin < box.ymin || box.ymax < inner.ymax;
    return !reachesOut && this->liesInsideExactly({ box.xmin, box.ymin }, { box.xmax, box.ymax });
  }

  /// A box that contains the disk: rounded outward, and infinite if doubles cannot bound it.
  Box2 bounds() const
  {
    return { this->Low[0] - this->Largest, this->Low[1] - this->Largest,
      this->High[0] + this->Largest, this->High[1] + this->Largest };
  }
};

/// The closed ball through the corners of a tetrahedron, computed once and tested exactly against
/// many boxes. orientation3() of the finite corners must be positive.
class VTKTIPPACCELERATORS_EXPORT Circumball : BallIntervals<3>
{
public:
  Circumball(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

  /// Whether ball and box share a point; touching counts.
  bool meets(const Box3& box) const { return this->meetsBox(box.Min, box.Max); }

  /// A quick sufficient test: true only if the ball of the tetrahedron lies in the interior of the
  /// box. May be false for a ball close to the box's border or for a thin tetrahedron.
  static bool isSurelyInside(
    const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box);

  /// A quicker sufficient test: true only if the ball's diameter is below this one. Then it lies in
  /// the interior of every box whose sides are that far from `a`.
  static bool isSurelySmall(
    const Point3& a, const Point3& b, const Point3& c, const Point3& d, double diameter);
};

} // namespace tipp

#endif
