// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCircumball_h
#define tippCircumball_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tipp
{

/// The closed ball through the corners of a tetrahedron, computed once and tested exactly against
/// many boxes.
///
/// Stores its centre and radius as intervals of doubles; if these leave a test undecided,
/// arbitrary-precision integers decide. orientation3() of the finite corners must be positive.
class VTKTIPPACCELERATORS_EXPORT Circumball
{
public:
  Circumball(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

  /// Whether ball and box share a point; touching counts.
  bool meets(const Box3& box) const
  {
    // Lower and upper bound of the distance from the centre to the nearest point of the box.
    double near = 0;
    double far = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double atLeast = gap(box.Min[k] - this->High[k], this->Low[k] - box.Max[k]);
      const double atMost = gap(box.Min[k] - this->Low[k], this->High[k] - box.Max[k]);
      near += atLeast * atLeast;
      far += atMost * atMost;
    }
    if (near > this->LargestSquare)
    {
      return false;
    }
    return far <= this->SmallestSquare || this->meetsExactly(box);
  }

  /// A quick sufficient test: true only if the ball of the tetrahedron lies in the interior of the
  /// box. May be false for a ball close to the box's border or for a thin tetrahedron.
  static bool isSurelyInside(
    const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box);

  /// A quicker sufficient test: true only if the ball's diameter is below this one. Then it lies in
  /// the interior of every box whose sides are that far from `a`.
  static bool isSurelySmall(
    const Point3& a, const Point3& b, const Point3& c, const Point3& d, double diameter);

private:
  static double gap(double before, double behind)
  {
    return std::max(std::max(before, behind), 0.0);
  }
  bool computeIntervals();
  void leaveOpen();
  bool meetsExactly(const Box3& box) const;

  std::array<Point3, 4> Corners;
  std::array<double, 3> Low;  // the centre lies between Low
  std::array<double, 3> High; // and High
  double SmallestSquare;      // interval of the squared radius,
  double LargestSquare;       // widened by the rounding of the squared distances in meets()
};

} // namespace tipp

#endif
