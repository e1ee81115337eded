// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCircumball_h
#define tippCircumball_h

#include "Predicates/Geometry.h"
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
public:
  /// A box that contains the ball: rounded outward, and infinite if doubles cannot bound it.
  Box<D> bounds() const
  {
    Box<D> box = this->Centre;
    for (std::size_t k = 0; k < D; ++k)
    {
      box.Min[k] -= this->Largest;
      box.Max[k] += this->Largest;
    }
    return box;
  }

protected:
  using Vector = Point<D>;
  static constexpr double Infinity = std::numeric_limits<double>::infinity();

  /// Leaves the intervals infinite, so that every test uses exact arithmetic.
  explicit BallIntervals(const std::array<Vector, D + 1>& corners)
    : Corners(corners)
  {
    for (std::size_t k = 0; k < D; ++k)
    {
      this->Centre.Min[k] = -Infinity;
      this->Centre.Max[k] = Infinity;
    }
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
      this->Centre.Min[k] = centre - error;
      this->Centre.Max[k] = centre + error;
    }
    this->Largest = radius + radiusError;
    this->Smallest = std::max(0.0, radius - radiusError);
    this->LargestSquare = this->Largest * this->Largest;
    this->SmallestSquare = this->Smallest * this->Smallest;
  }

  /// Whether the ball and the box share a point.
  bool meetsBox(const Box<D>& box) const
  {
    // Lower and upper bound of the distance from the centre to the nearest point of the box.
    double near = 0;
    double far = 0;
    for (std::size_t k = 0; k < D; ++k)
    {
      const double atLeast =
        gap(box.Min[k] - this->Centre.Max[k], this->Centre.Min[k] - box.Max[k]);
      near += atLeast * atLeast;
    }
    if (near > this->LargestSquare)
    {
      return false;
    }
    for (std::size_t k = 0; k < D; ++k)
    {
      const double atMost = gap(box.Min[k] - this->Centre.Min[k], this->Centre.Max[k] - box.Max[k]);
      far += atMost * atMost;
    }
    return far <= this->SmallestSquare || this->meetsExactly(box);
  }

  ///@{
  /// Exact, for boxes whose bounds may be infinite.
  bool meetsExactly(const Box<D>& box) const;
  bool liesInsideExactly(const Box<D>& box) const;
  ///@}

  std::array<Vector, D + 1> Corners;
  Box<D> Centre;        // contains the centre
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

  using BallIntervals<2>::bounds;

  /// Whether disk and box share a point; touching counts.
  bool meets(const Box2& box) const { return this->meetsBox(box); }

  /// Whether the disk lies in the box; touching the box's border from inside counts.
  bool inside(const Box2& box) const
  {
    if (box.contains(this->bounds()))
    {
      return true;
    }
    // The disk reaches or crosses each side of this box.
    const Box2& centre = this->Centre;
    const Box2 inner = { { centre.Max.x - this->Smallest, centre.Max.y - this->Smallest },
      { centre.Min.x + this->Smallest, centre.Min.y + this->Smallest } };
    const bool reachesOut = inner.Min.x < box.Min.x || box.Max.x < inner.Max.x ||
      inner.Min.y < box.Min.y || box.Max.y < inner.Max.y;
    return !reachesOut && this->liesInsideExactly(box);
  }
};

/// The closed ball through the corners of a tetrahedron, computed once and tested exactly against
/// many boxes. orientation3() of the finite corners must be positive.
class VTKTIPPACCELERATORS_EXPORT Circumball : BallIntervals<3>
{
public:
  Circumball(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

  using BallIntervals<3>::bounds;

  /// Whether ball and box share a point; touching counts.
  bool meets(const Box3& box) const { return this->meetsBox(box); }

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
