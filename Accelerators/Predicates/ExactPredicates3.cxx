// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactPredicates3.h"

#include "Predicates/Dyadic.h"
#include "Predicates/ExactArithmetic.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tipp
{
namespace
{

using ExactVector = std::array<Dyadic, 3>;

ExactVector exactVector(const Point3& p, const Point3& origin)
{
  return { Dyadic(p.x) - origin.x, Dyadic(p.y) - origin.y, Dyadic(p.z) - origin.z };
}

int orientationAnyLength(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  const std::array<ExactVector, 3> u = { exactVector(b, a), exactVector(c, a), exactVector(d, a) };
  const auto minor = [&u](std::size_t i, std::size_t j)
  { return u[i][0] * u[j][1] - u[j][0] * u[i][1]; };
  return (u[2][2] * minor(0, 1) + u[0][2] * minor(1, 2) + u[1][2] * minor(2, 0)).sign();
}

// Differences below 2^63: minors below 2^127, the determinant below 2^192.
int orientationOfIntegers(const std::array<std::int64_t, 3>& x,
  const std::array<std::int64_t, 3>& y, const std::array<std::int64_t, 3>& z)
{
  const auto minor = [&](int i, int j)
  { return static_cast<Int128>(x[i]) * y[j] - static_cast<Int128>(x[j]) * y[i]; };
  Int256 sum = Int256::product(minor(0, 1), z[2]);
  sum += Int256::product(minor(1, 2), z[0]);
  sum += Int256::product(minor(2, 0), z[1]);
  return sum.sign();
}

} // namespace

int orientation3Exact(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  // Most coplanar points lie in a plane perpendicular to an axis, such as the face of a box.
  const auto level = [&](double Point3::*axis)
  { return a.*axis == d.*axis && b.*axis == d.*axis && c.*axis == d.*axis; };
  if (level(&Point3::x) || level(&Point3::y) || level(&Point3::z))
  {
    return 0;
  }
  const auto spanOf = [&](double Point3::*axis)
  {
    BitSpan span;
    for (const Point3* p : { &b, &c, &d })
    {
      span.includeDifference(p->*axis, a.*axis);
    }
    return span;
  };
  const BitSpan x = spanOf(&Point3::x);
  const BitSpan y = spanOf(&Point3::y);
  const BitSpan z = spanOf(&Point3::z);
  if (!x.fits(63) || !y.fits(63) || !z.fits(63))
  {
    return orientationAnyLength(a, b, c, d);
  }
  const auto units = [&](double Point3::*axis, const BitSpan& span) -> std::array<std::int64_t, 3>
  {
    const double scale = span.scale();
    return { longUnits(b.*axis, a.*axis, scale), longUnits(c.*axis, a.*axis, scale),
      longUnits(d.*axis, a.*axis, scale) };
  };
  return orientationOfIntegers(units(&Point3::x, x), units(&Point3::y, y), units(&Point3::z, z));
}

int normalAxis(const Point3& a, const Point3& b, const Point3& c)
{
  const ExactVector ab = exactVector(b, a);
  const ExactVector ac = exactVector(c, a);
  int longest = 0;
  Dyadic length = -1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const Dyadic component = ab[u] * ac[v] - ab[v] * ac[u];
    const Dyadic magnitude = component.sign() < 0 ? -component : component;
    if (compare(magnitude, length) >= 0)
    {
      length = magnitude;
      longest = int(axis);
    }
  }
  return longest;
}

namespace
{

using Differences = std::array<std::int64_t, 4>;

/// A two's complement integer of 384 bits. Sums wrap modulo 2^384.
class WideSum
{
public:
  /// Adds a product.
  void add(const Int256& factor, UInt128 lift)
  {
    const std::uint64_t extension = factor.sign() < 0 ? ~std::uint64_t(0) : 0;
    const std::array<std::uint64_t, Limbs> a = { std::uint64_t(factor.low()),
      std::uint64_t(factor.low() >> 64), std::uint64_t(factor.high()),
      std::uint64_t(factor.high() >> 64), extension, extension };
    this->addShifted(a, static_cast<std::uint64_t>(lift), 0);
    this->addShifted(a, static_cast<std::uint64_t>(lift >> 64), 1);
  }

  /// -1, 0 or +1.
  int sign() const
  {
    if (this->Sum[Limbs - 1] >> 63 != 0)
    {
      return -1;
    }
    const auto isSet = [](std::uint64_t limb) { return limb != 0; };
    return std::any_of(this->Sum.begin(), this->Sum.end(), isSet) ? 1 : 0;
  }

private:
  static constexpr std::size_t Limbs = 6;

  void addShifted(
    const std::array<std::uint64_t, Limbs>& a, std::uint64_t factor, std::size_t shift)
  {
    UInt128 carry = 0;
    for (std::size_t i = 0; i + shift < Limbs; ++i)
    {
      carry += static_cast<UInt128>(a[i]) * factor;
      // The product and two more limbs fit: (2^64 - 1)^2 + 2 (2^64 - 1) = 2^128 - 1.
      carry += this->Sum[i + shift];
      this->Sum[i + shift] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
  }

  std::array<std::uint64_t, Limbs> Sum = {};
};

/// Sign of the in-sphere determinant for differences of 63 digits: minors are below 2^127,
/// determinants of three below 2^192, lifts below 2^128, and their sum of products below 2^322.
int inSphereSign63(const Differences& x, const Differences& y, const Differences& z)
{
  const auto minor = [&](std::size_t i, std::size_t j)
  { return static_cast<Int128>(x[i]) * y[j] - static_cast<Int128>(x[j]) * y[i]; };
  const auto lift = [&](std::size_t i)
  {
    const auto square = [](std::int64_t n) { return UInt128(static_cast<Int128>(n) * n); };
    return square(x[i]) + square(y[i]) + square(z[i]);
  };
  WideSum sum;
  // Adds corner i's term; j, k, l are the other corners, in the order that makes the term positive.
  const auto add = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l)
  {
    Int256 volume = Int256::product(minor(k, l), z[j]);
    volume += Int256::product(minor(l, j), z[k]);
    volume += Int256::product(minor(j, k), z[l]);
    sum.add(volume, lift(i));
  };
  add(0, 1, 2, 3);
  add(1, 0, 3, 2);
  add(2, 0, 1, 3);
  add(3, 0, 2, 1);
  return sum.sign();
}

/// The sign of the in-sphere determinant if doubles can decide it, else 0. Sharper than isCertain()
/// if the extents along the axes differ much, since each product is bounded separately.
//
// Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997: the error is at most
// (16 + 224 e) e P, P the sum of the products' magnitudes. Products below the normal range are off
// by 2^-1074, which is multiplied by less than 1e45 if the lifts' sum is below 1e30.
int signByPermanent(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  const InSphereValue value = inSphereValue(a, b, c, d, p);
  const std::array<Point3, 4> u = { a - p, b - p, c - p, d - p };
  const auto minor = [&u](std::size_t i, std::size_t j)
  { return std::fabs(u[i].x * u[j].y) + std::fabs(u[j].x * u[i].y); };
  double permanent = 0;
  const auto add = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l)
  {
    const double lift = u[i].x * u[i].x + u[i].y * u[i].y + u[i].z * u[i].z;
    permanent += lift *
      (std::fabs(u[j].z) * minor(k, l) + std::fabs(u[k].z) * minor(j, l) +
        std::fabs(u[l].z) * minor(j, k));
  };
  add(0, 1, 2, 3);
  add(1, 0, 2, 3);
  add(2, 0, 1, 3);
  add(3, 0, 1, 2);
  const double bound = 17 * 0x1p-53 * permanent + 1e-270;
  // Also false after an overflow.
  return value.lifts < 1e30 && std::fabs(value.determinant) > bound ? signOf(value.determinant) : 0;
}

int inSphereAnyLength(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  const std::array<ExactVector, 4> u = { exactVector(a, p), exactVector(b, p), exactVector(c, p),
    exactVector(d, p) };
  const auto lift = [&u](std::size_t i)
  { return u[i][0] * u[i][0] + u[i][1] * u[i][1] + u[i][2] * u[i][2]; };
  const auto minor = [&u](std::size_t i, std::size_t j)
  { return u[i][0] * u[j][1] - u[j][0] * u[i][1]; };
  const auto volume = [&](std::size_t i, std::size_t j, std::size_t k)
  { return u[i][2] * minor(j, k) + u[j][2] * minor(k, i) + u[k][2] * minor(i, j); };
  return (lift(0) * volume(1, 2, 3) + lift(1) * volume(0, 3, 2) + lift(2) * volume(0, 1, 3) +
    lift(3) * volume(0, 2, 1))
    .sign();
}

} // namespace

int inSphereExact(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  if (const int sign = signByPermanent(a, b, c, d, p))
  {
    return sign;
  }
  BitSpan span;
  for (const Point3* corner : { &a, &b, &c, &d })
  {
    span.includeDifference(corner->x, p.x);
    span.includeDifference(corner->y, p.y);
    span.includeDifference(corner->z, p.z);
  }
  if (!span.fits(63))
  {
    return inSphereAnyLength(a, b, c, d, p);
  }
  const auto units = [&](double Point3::*axis) -> Differences
  {
    const double scale = span.scale();
    return { longUnits(a.*axis, p.*axis, scale), longUnits(b.*axis, p.*axis, scale),
      longUnits(c.*axis, p.*axis, scale), longUnits(d.*axis, p.*axis, scale) };
  };
  return inSphereSign63(units(&Point3::x), units(&Point3::y), units(&Point3::z));
}

bool tieIsInsideSphere(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  std::array<const Point3*, 5> byCoordinates = { &a, &b, &c, &d, &p };
  std::sort(byCoordinates.begin(), byCoordinates.end(),
    [](const Point3* one, const Point3* other) { return lexicographicLess(*other, *one); });
  for (const Point3* largest : byCoordinates)
  {
    if (largest == &p || *largest == p)
    {
      return false;
    }
    const auto corner = [&](const Point3& own) -> const Point3&
    { return largest == &own ? p : own; };
    const int side = orientation3(corner(a), corner(b), corner(c), corner(d));
    if (side != 0)
    {
      return side > 0;
    }
  }
  return false;
}

namespace
{

// A Box2 is the projection of a box along an axis.

// +1 or -1 if the rectangle lies strictly on that side of the directed line ab, else 0.
int strictSide(Point2 a, Point2 b, const Box2& box)
{
  // The rectangle's extreme corners to the left and to the right of the line.
  const bool east = b.x > a.x;
  const bool north = b.y > a.y;
  const Point2 left = { north ? box.Min.x : box.Max.x, east ? box.Max.y : box.Min.y };
  const Point2 right = { north ? box.Max.x : box.Min.x, east ? box.Min.y : box.Max.y };
  if (orientation(a, b, right) > 0)
  {
    return 1;
  }
  return orientation(a, b, left) < 0 ? -1 : 0;
}

// Whether a line parallel to ab lies strictly between the rectangle and the points: the rectangle
// is strictly on one side of ab, and none of the other points is on that side.
template <std::size_t N>
bool edgeSeparates(Point2 a, Point2 b, const std::array<Point2, N>& others, const Box2& box)
{
  const int side = strictSide(a, b, box);
  return side != 0 &&
    std::none_of(
      others.begin(), others.end(), [&](Point2 other) { return orientation(a, b, other) == side; });
}

// Tests the six edges of the tetrahedron, projected along one axis.
bool edgesSeparate(const std::array<Point2, 4>& p, const Box2& box)
{
  return edgeSeparates<2>(p[0], p[1], { p[2], p[3] }, box) ||
    edgeSeparates<2>(p[0], p[2], { p[1], p[3] }, box) ||
    edgeSeparates<2>(p[0], p[3], { p[1], p[2] }, box) ||
    edgeSeparates<2>(p[1], p[2], { p[0], p[3] }, box) ||
    edgeSeparates<2>(p[1], p[3], { p[0], p[2] }, box) ||
    edgeSeparates<2>(p[2], p[3], { p[0], p[1] }, box);
}

// Whether the box lies strictly on one side of the plane of a, b, c, and d does not.
bool faceSeparates(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box)
{
  // The signs of the normal's components, and so the box's extreme corners along it.
  const int x = orientation({ a.y, a.z }, { b.y, b.z }, { c.y, c.z });
  const int y = orientation({ a.z, a.x }, { b.z, b.x }, { c.z, c.x });
  const int z = orientation({ a.x, a.y }, { b.x, b.y }, { c.x, c.y });
  const Point3 highest = { x > 0 ? box.Max.x : box.Min.x, y > 0 ? box.Max.y : box.Min.y,
    z > 0 ? box.Max.z : box.Min.z };
  const Point3 lowest = { x > 0 ? box.Min.x : box.Max.x, y > 0 ? box.Min.y : box.Max.y,
    z > 0 ? box.Min.z : box.Max.z };
  int side = orientation3(a, b, c, lowest) > 0 ? 1 : 0;
  if (side == 0 && orientation3(a, b, c, highest) < 0)
  {
    side = -1;
  }
  return side != 0 && orientation3(a, b, c, d) != side;
}

template <std::size_t N>
bool apartAlongAxis(const std::array<double, N>& values, double low, double high)
{
  return *std::max_element(values.begin(), values.end()) < low ||
    *std::min_element(values.begin(), values.end()) > high;
}

bool boundsMeet(const std::array<Point3, 4>& p, const Box3& box)
{
  return !apartAlongAxis<4>({ p[0].x, p[1].x, p[2].x, p[3].x }, box.Min.x, box.Max.x) &&
    !apartAlongAxis<4>({ p[0].y, p[1].y, p[2].y, p[3].y }, box.Min.y, box.Max.y) &&
    !apartAlongAxis<4>({ p[0].z, p[1].z, p[2].z, p[3].z }, box.Min.z, box.Max.z);
}

} // namespace

bool triangleMeetsBox(Point2 a, Point2 b, Point2 c, const Box3& box)
{
  const Box2 shadow = projected<2>(box);
  if (shadow.contains(a) || shadow.contains(b) || shadow.contains(c))
  {
    return true;
  }
  return !apartAlongAxis<3>({ a.x, b.x, c.x }, box.Min.x, box.Max.x) &&
    !apartAlongAxis<3>({ a.y, b.y, c.y }, box.Min.y, box.Max.y) &&
    !edgeSeparates<1>(a, b, { c }, shadow) && !edgeSeparates<1>(b, c, { a }, shadow) &&
    !edgeSeparates<1>(c, a, { b }, shadow);
}

bool tetrahedronMeetsBox(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box)
{
  const std::array<Point3, 4> p = { a, b, c, d };
  if (std::any_of(p.begin(), p.end(), [&](const Point3& corner) { return box.contains(corner); }))
  {
    return true;
  }
  if (!boundsMeet(p, box) || faceSeparates(a, b, c, d, box) || faceSeparates(a, b, d, c, box) ||
    faceSeparates(a, c, d, b, box) || faceSeparates(b, c, d, a, box))
  {
    return false;
  }
  const auto seen = [&](auto first, auto second)
  {
    return std::array<Point2, 4>{ { { a.*first, a.*second }, { b.*first, b.*second },
      { c.*first, c.*second }, { d.*first, d.*second } } };
  };
  const auto shadow = [&](std::size_t first, std::size_t second) {
    return Box2{ { box.Min[first], box.Min[second] }, { box.Max[first], box.Max[second] } };
  };
  return !edgesSeparate(seen(&Point3::x, &Point3::y), shadow(0, 1)) &&
    !edgesSeparate(seen(&Point3::y, &Point3::z), shadow(1, 2)) &&
    !edgesSeparate(seen(&Point3::z, &Point3::x), shadow(2, 0));
}

} // namespace tipp
