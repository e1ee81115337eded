// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInSphere_h
#define tippInSphere_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

namespace tipp
{

/// The in-sphere determinant in doubles, and the sum of its four lifts, which bounds its error.
struct InSphereValue
{
  double determinant;
  double lifts;
};

/// Evaluates the in-sphere determinant of p and the tetrahedron a, b, c, d without error control.
inline InSphereValue inSphereValue(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  const auto [ax, ay, az] = a - p;
  const auto [bx, by, bz] = b - p;
  const auto [cx, cy, cz] = c - p;
  const auto [dx, dy, dz] = d - p;
  const double ab = ax * by - bx * ay;
  const double bc = bx * cy - cx * by;
  const double cd = cx * dy - dx * cy;
  const double da = dx * ay - ax * dy;
  const double ac = ax * cy - cx * ay;
  const double bd = bx * dy - dx * by;
  const double abc = az * bc - bz * ac + cz * ab;
  const double bcd = bz * cd - cz * bd + dz * bc;
  const double cda = cz * da + dz * ac + az * cd;
  const double dab = dz * ab + az * bd + bz * da;
  const double aLift = ax * ax + ay * ay + az * az;
  const double bLift = bx * bx + by * by + bz * bz;
  const double cLift = cx * cx + cy * cy + cz * cz;
  const double dLift = dx * dx + dy * dy + dz * dz;
  return { (aLift * bcd - bLift * cda) + (cLift * dab - dLift * abc),
    (aLift + bLift) + (cLift + dLift) };
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

/// Like inSphere(), for callers whose own filter has failed: tries a sharper filter, then exact
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

} // namespace tipp

#endif
