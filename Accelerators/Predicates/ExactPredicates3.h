// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactPredicates3_h
#define tippExactPredicates3_h

#include "Predicates/ExactPredicates.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cmath>

namespace tipp
{

/// Returns orientation3() by exact arithmetic, without a filter in doubles.
VTKTIPPACCELERATORS_EXPORT int orientation3Exact(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Exact for all finite coordinates: +1 if a, b, c turn counter-clockwise seen from d, -1 if
/// clockwise, 0 if the four are coplanar. It is the sign of ((b - a) x (c - a)) . (d - a), which is
/// +1 for a tetrahedron in VTK's order.
inline int orientation3(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  // (7 + 56 e) e, e = 2^-53: Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997,
  // section 4.3.
  constexpr double relative = 7.7715611723761e-16;
  const auto [ax, ay, az] = a - d;
  const auto [bx, by, bz] = b - d;
  const auto [cx, cy, cz] = c - d;
  const double minus =
    az * (bx * cy - cx * by) + bz * (cx * ay - ax * cy) + cz * (ax * by - bx * ay);
  const double heights = std::fabs(az) + std::fabs(bz) + std::fabs(cz);
  const double permanent = std::fabs(az) * (std::fabs(bx * cy) + std::fabs(cx * by)) +
    std::fabs(bz) * (std::fabs(cx * ay) + std::fabs(ax * cy)) +
    std::fabs(cz) * (std::fabs(ax * by) + std::fabs(bx * ay));
  // A product below the normal range loses at most 2^-1075, which is multiplied by a height.
  const double bound = relative * permanent + 1e-300 * (1.0 + heights);
  // After an overflow the bound is infinite or NaN, and both comparisons are false.
  if (minus > bound)
  {
    return -1;
  }
  if (-minus > bound)
  {
    return 1;
  }
  return orientation3Exact(a, b, c, d);
}

/// The coordinate axis (0, 1 or 2) in which the normal of the plane through three points, which
/// must not be collinear, is longest; of axes in which it is equally long the last one. Exact for
/// all finite coordinates, so the same for any three points of a plane. Projection along this axis
/// maps no two points of the plane to one.
VTKTIPPACCELERATORS_EXPORT int normalAxis(const Point3& a, const Point3& b, const Point3& c);

/// A point relative to another one, and the sum of the squares of its coordinates. Number: a
/// double, or a vector of doubles.
template <typename Number>
struct LiftedPoint
{
  Number x;
  Number y;
  Number z;
  Number lift;
};

/// The in-sphere determinant, and the sum of its four lifts, which bounds its error.
template <typename Number>
struct InSphereValueOf
{
  Number determinant;
  Number lifts;
};
using InSphereValue = InSphereValueOf<double>;

/// Evaluates the in-sphere determinant of the origin and a tetrahedron without error control.
template <typename Number>
[[gnu::always_inline]] inline InSphereValueOf<Number> inSphereValue(const LiftedPoint<Number>& a,
  const LiftedPoint<Number>& b, const LiftedPoint<Number>& c, const LiftedPoint<Number>& d)
{
  const Number ab = a.x * b.y - b.x * a.y;
  const Number bc = b.x * c.y - c.x * b.y;
  const Number cd = c.x * d.y - d.x * c.y;
  const Number da = d.x * a.y - a.x * d.y;
  const Number ac = a.x * c.y - c.x * a.y;
  const Number bd = b.x * d.y - d.x * b.y;
  const Number abc = a.z * bc - b.z * ac + c.z * ab;
  const Number bcd = b.z * cd - c.z * bd + d.z * bc;
  const Number cda = c.z * da + d.z * ac + a.z * cd;
  const Number dab = d.z * ab + a.z * bd + b.z * da;
  return { (a.lift * bcd - b.lift * cda) + (c.lift * dab - d.lift * abc),
    (a.lift + b.lift) + (c.lift + d.lift) };
}

/// Evaluates the in-sphere determinant of p and the tetrahedron a, b, c, d without error control.
inline InSphereValue inSphereValue(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  const auto lifted = [&p](const Point3& at) -> LiftedPoint<double>
  {
    const auto [x, y, z] = at - p;
    return { x, y, z, x * x + y * y + z * z };
  };
  return inSphereValue(lifted(a), lifted(b), lifted(c), lifted(d));
}

/// Whether the sign of the determinant is certain, for any coordinates.
//
// Each term is a lift (5 roundings: the difference counts twice) times a determinant of three
// differences (8) and takes part in a product and two sums: |error| <= (16 e + second order) P,
// e = 2^-53, P the sum of lift times permanent. The permanent of three vectors is at most
// 3! / 3^(3/2) = 1.155 times the product of their lengths (Carlen, Lieb, Loss 2006). With the
// lifts' sum S, the sum of lift_i sqrt(lift_j lift_k lift_l) is at most S^(5/2) / 8. So
// |error| <= 2.4 e S^(5/2); 3 e is used, squared, because a root takes longer.
//
// Underflow: a square above 1e-280 is a determinant above 1e-140. Products below the normal range
// are off by 2^-1074, which is multiplied by at most S^(3/2) < 1e93, for beyond that S^5 overflows
// and the comparison is false.
inline bool isCertain(const InSphereValue& value)
{
  constexpr double relative = 9 * 0x1p-106;
  constexpr double absolute = 1e-280;
  const double square = value.lifts * value.lifts;
  return value.determinant * value.determinant >
    relative * (square * square) * value.lifts + absolute;
}

/// Returns inSphere() for callers whose own filter has failed: tries a sharper filter, then exact
/// arithmetic.
VTKTIPPACCELERATORS_EXPORT int inSphereExact(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p);

/// The position of p relative to the sphere through a, b, c, d, where orientation3(a, b, c, d) must
/// be positive. Exact for all finite coordinates: +1 strictly inside, 0 on the sphere, -1 outside.
inline int inSphere(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  const InSphereValue value = inSphereValue(a, b, c, d, p);
  return isCertain(value) ? (value.determinant > 0 ? 1 : -1) : inSphereExact(a, b, c, d, p);
}

/// The tie rule alone: whether p counts as inside if it lies on the sphere of a, b, c, d.
//
// Devillers and Teillaud, Perturbations for Delaunay and weighted Delaunay 3D triangulations, 2011:
// lift the lexicographically largest of the five points by the largest infinitesimal, the next by
// the next, and so on. p is outside if its lift decides; else the sign is that of the tetrahedron
// in which p replaces that corner, unless the four are coplanar. A p equal to a corner is outside.
VTKTIPPACCELERATORS_EXPORT bool tieIsInsideSphere(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p);

/// Exact in-sphere test with ties broken by coordinates alone, as CGAL's Delaunay_triangulation_3
/// does: it makes the triangulation of a point set unique, without flat tetrahedra.
inline bool inSpherePerturbed(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  const int side = inSphere(a, b, c, d, p);
  return side > 0 || (side == 0 && tieIsInsideSphere(a, b, c, d, p));
}

// Two convex sets are disjoint if and only if a line, or in 3D a plane, that is parallel to a side
// of one of them or to an edge of each lies strictly between them (the separating axes of
// Gottschalk, Lin and Manocha, OBBTree, 1996). Each axis takes a few orientation tests, which are
// exact.

/// Whether the closed triangle and the closed box share a point, in x and y; touching counts. Exact
/// for finite coordinates, even if the triangle or the box is a segment or a point.
VTKTIPPACCELERATORS_EXPORT bool triangleMeetsBox(Point2 a, Point2 b, Point2 c, const Box3& box);

/// Whether the closed tetrahedron and the closed box share a point; touching counts. Exact for
/// finite coordinates, even if either is flat: with c = d this tests a triangle in space.
VTKTIPPACCELERATORS_EXPORT bool tetrahedronMeetsBox(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box);

} // namespace tipp

#endif
