// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/KernelPredicates.h"

#include "Predicates/ExactArithmetic.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
namespace
{

bool isInHalfPlane(Point2 u, Point2 w, Point2 p)
{
  const int side = orientation(u, w, p);
  if (side != 0)
  {
    return side > 0;
  }
  return lexicographicLess(u, w) ? lexicographicLess(u, p) && lexicographicLess(p, w)
                                 : lexicographicLess(w, p) && lexicographicLess(p, u);
}

} // namespace

void KernelPredicates::restart(const Point2* points, std::size_t count)
{
  this->Points = points;
  this->Count = count;
  this->GridIsCurrent = false;
  this->Turns = 0;
}

const CoordinateGrid& KernelPredicates::grid()
{
  if (!this->GridIsCurrent)
  {
    this->Grid.analyse(this->Points + 1, this->Count - 1);
    this->GridIsCurrent = true;
  }
  return this->Grid;
}

int KernelPredicates::orientation(HalfEdgeMesh::Index ia, HalfEdgeMesh::Index ib, Point2 p)
{
  const Point2 a = this->Points[ia];
  const Point2 b = this->Points[ib];
  // Any input makes a few filters fail; the coordinate grid pays only if there are many failures.
  constexpr std::size_t few = 32;
  return ++this->Turns > few ? this->grid().orientation(a, b, p) : orientationExact(a, b, p);
}

bool KernelPredicates::isInConflict(const HalfEdgeMesh::Index* corners, Point2 p)
{
  const Point2 a = this->Points[corners[0]];
  const Point2 b = this->Points[corners[1]];
  const Point2 c = this->Points[corners[2]];
  for (int i = 0; i < 3; ++i)
  {
    if (corners[i] == InfiniteVertex)
    {
      return isInHalfPlane(
        this->Points[corners[(i + 1) % 3]], this->Points[corners[(i + 2) % 3]], p);
    }
  }
  const int side = this->grid().inCircle(a, b, c, p);
  return side != 0 ? side > 0 : tieIsInside(a, b, c, p);
}

void KernelPredicates3::restart(const Point3* points, std::size_t count)
{
  this->Points = points;
  this->Count = count;
  this->Failures = 0;
  this->ExactLifts = -1; // no sum of lifts is below this
  this->ExactDifference = 0;
}

/// Counts uncertain results. A few occur for any input; after some more it pays to look for a
/// common unit of the coordinates.
///
/// If differences are at most 2^k units, all terms of the in-sphere determinant and their partial
/// sums are integers below 72 * 2^(5 k) < 2^(5 k + 6.2), times unit^5. Doubles hold them exactly
/// for k = 9, and therefore if the sum of the squared differences is at most 2^18 squared units.
/// For an orientation the integers are below 6 * 2^(3 k), which is exact for k = 16.
void KernelPredicates3::countFailure()
{
  constexpr std::size_t few = 32;
  if (++this->Failures != few)
  {
    return;
  }
  BitSpan span;
  constexpr std::size_t block = 1024;
  for (std::size_t i = 1; i < this->Count; ++i)
  {
    span.includeDifference(this->Points[i].x, this->Points[1].x);
    span.includeDifference(this->Points[i].y, this->Points[1].y);
    span.includeDifference(this->Points[i].z, this->Points[1].z);
    if (i % block == 0 && !span.fits(63))
    {
      return;
    }
  }
  const double unit = span.fits(63) ? 1 / span.scale() : 0;
  // The fifth power of the unit must be a normal number.
  if (unit >= 0x1p-180 && unit <= 0x1p180)
  {
    this->ExactLifts = 0x1p18 * unit * unit;
    this->ExactDifference = 0x1p16 * unit;
  }
}

bool KernelPredicates3::isInFiniteConflict(
  const Index* v, const Point3& p, const InSphereValue& value)
{
  this->countFailure();
  const Point3& a = this->Points[v[0]];
  const Point3& b = this->Points[v[1]];
  const Point3& c = this->Points[v[2]];
  const Point3& d = this->Points[v[3]];
  const int side =
    value.lifts <= this->ExactLifts ? signOf(value.determinant) : inSphereExact(a, b, c, d, p);
  return side != 0 ? side > 0 : tieIsInsideSphere(a, b, c, d, p);
}

bool KernelPredicates3::isInInfiniteConflict(const Index* slots, Index cell, const Point3& p)
{
  const Index* const v = slots + cell;
  const int side = this->orientation(p, this->Points[v[1]], this->Points[v[2]], this->Points[v[3]]);
  return side != 0 ? side > 0 : this->isInFiniteConflict(slots + TetrahedronMesh::cellOf(v[4]), p);
}

int KernelPredicates3::orientation(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  if (this->ExactDifference > 0)
  {
    const Point3 u = b - a;
    const Point3 v = c - a;
    const Point3 w = d - a;
    const double largest =
      std::max({ std::fabs(u.x), std::fabs(u.y), std::fabs(u.z), std::fabs(v.x), std::fabs(v.y),
        std::fabs(v.z), std::fabs(w.x), std::fabs(w.y), std::fabs(w.z) });
    if (largest <= this->ExactDifference)
    {
      return signOf(u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
        u.z * (v.x * w.y - v.y * w.x));
    }
  }
  return orientation3(a, b, c, d);
}

} // namespace tipp
