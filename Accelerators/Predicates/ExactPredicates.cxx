// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactPredicates.h"

#include "Predicates/ExactArithmetic.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tipp
{
namespace
{

// Computed with the coordinates themselves, because differences of coordinates with very different
// exponents have too many digits.
int orientationAnyLength(Point2 a, Point2 b, Point2 c)
{
  const BinaryNumber x[3] = { binaryNumber(a.x), binaryNumber(b.x), binaryNumber(c.x) };
  const BinaryNumber y[3] = { binaryNumber(a.y), binaryNumber(b.y), binaryNumber(c.y) };
  ProductSum<6, 106> determinant;
  for (int i = 0; i < 3; ++i)
  {
    const int next = (i + 1) % 3;
    determinant.add(x[i], y[next]);
    determinant.add(-x[next], y[i]);
  }
  return determinant.sign();
}

} // namespace

int orientationExact(Point2 a, Point2 b, Point2 c)
{
  const ExactDifference ux = exactDifference(a.x, c.x);
  const ExactDifference uy = exactDifference(a.y, c.y);
  const ExactDifference vx = exactDifference(b.x, c.x);
  const ExactDifference vy = exactDifference(b.y, c.y);
  BitSpan x;
  BitSpan y;
  x.include(ux);
  x.include(vx);
  y.include(uy);
  y.include(vy);
  if (!x.fits(63) || !y.fits(63))
  {
    return orientationAnyLength(a, b, c);
  }
  return orientationSign63(scaledToInteger(ux, x.scale()), scaledToInteger(uy, y.scale()),
    scaledToInteger(vx, x.scale()), scaledToInteger(vy, y.scale()));
}

namespace
{

// Each product has one factor from each axis, so each axis may be scaled by its own power of two.
int orientationAnyLength(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  const auto x = toCommonExponent<4>({ a.x, b.x, c.x, d.x });
  const auto y = toCommonExponent<4>({ a.y, b.y, c.y, d.y });
  const auto z = toCommonExponent<4>({ a.z, b.z, c.z, d.z });
  const auto minor = [&](int i, int j) -> mpz_class
  { return (x[i] - x[0]) * (y[j] - y[0]) - (x[j] - x[0]) * (y[i] - y[0]); };
  const mpz_class determinant =
    (z[3] - z[0]) * minor(1, 2) + (z[1] - z[0]) * minor(2, 3) + (z[2] - z[0]) * minor(3, 1);
  return sgn(determinant);
}

// Differences to the first point along one axis.
struct AxisDifferences
{
  AxisDifferences(double first, double b, double c, double d)
    : Values{ exactDifference(b, first), exactDifference(c, first), exactDifference(d, first) }
  {
    for (const ExactDifference& value : this->Values)
    {
      this->Span.include(value);
    }
  }

  std::array<std::int64_t, 3> integers() const
  {
    const double scale = this->Span.scale();
    return { scaledToInteger(this->Values[0], scale), scaledToInteger(this->Values[1], scale),
      scaledToInteger(this->Values[2], scale) };
  }

  std::array<ExactDifference, 3> Values;
  BitSpan Span;
};

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
  const AxisDifferences x(a.x, b.x, c.x, d.x);
  const AxisDifferences y(a.y, b.y, c.y, d.y);
  const AxisDifferences z(a.z, b.z, c.z, d.z);
  if (!x.Span.fits(63) || !y.Span.fits(63) || !z.Span.fits(63))
  {
    return orientationAnyLength(a, b, c, d);
  }
  return orientationOfIntegers(x.integers(), y.integers(), z.integers());
}

namespace
{

constexpr int MantissaDigits = 53;
constexpr int LowestExponent = -1074; ///< exponent of the lowest digit of a double

int digits(const mpz_class& value)
{
  return int(mpz_sizeinbase(value.get_mpz_t(), 2));
}

/// numerator / denominator * 2^exponent, rounded once to the nearest double.
double roundedQuotient(mpz_class numerator, mpz_class denominator, int exponent)
{
  const int sign = sgn(numerator) * sgn(denominator);
  numerator = abs(numerator);
  denominator = abs(denominator);
  if (sign == 0)
  {
    return 0;
  }
  // The quotient gets at least one digit more than a mantissa.
  const int shift = std::max(0, MantissaDigits + 2 + digits(denominator) - digits(numerator));
  numerator <<= static_cast<mp_bitcnt_t>(shift);
  exponent -= shift;
  mpz_class quotient = numerator / denominator;
  const bool isInexact = quotient * denominator != numerator;
  const int dropped = std::max(digits(quotient) - MantissaDigits, LowestExponent - exponent);
  if (dropped > 0)
  {
    const mpz_class half = mpz_class(1) << static_cast<mp_bitcnt_t>(dropped - 1);
    const mpz_class kept = quotient >> static_cast<mp_bitcnt_t>(dropped);
    const mpz_class rest = quotient - (kept << static_cast<mp_bitcnt_t>(dropped));
    const bool isOdd = mpz_odd_p(kept.get_mpz_t()) != 0;
    const bool roundUp = rest > half || (rest == half && (isInexact || isOdd));
    quotient = roundUp ? mpz_class(kept + 1) : kept;
    exponent += dropped;
  }
  return sign * std::ldexp(quotient.get_d(), exponent);
}

} // namespace

Point2 crossingPoint(Point2 a, Point2 b, Point2 c, Point2 d)
{
  int exponent = 0;
  const std::array<mpz_class, 8> n =
    toCommonExponent<8>({ a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y }, &exponent);
  const mpz_class abX = n[2] - n[0];
  const mpz_class abY = n[3] - n[1];
  const mpz_class cdX = n[6] - n[4];
  const mpz_class cdY = n[7] - n[5];
  const mpz_class part = (n[4] - n[0]) * cdY - (n[5] - n[1]) * cdX;
  const mpz_class whole = abX * cdY - abY * cdX;
  return { roundedQuotient(n[0] * whole + abX * part, whole, exponent),
    roundedQuotient(n[1] * whole + abY * part, whole, exponent) };
}

namespace
{

// Computed with the coordinates themselves, because differences of coordinates with very different
// exponents have too many digits.
int inCircleAnyLength(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const BinaryNumber x[4] = { binaryNumber(a.x), binaryNumber(b.x), binaryNumber(c.x),
    binaryNumber(p.x) };
  const BinaryNumber y[4] = { binaryNumber(a.y), binaryNumber(b.y), binaryNumber(c.y),
    binaryNumber(p.y) };
  // The even permutations of the four rows; swapping the first two gives the odd ones.
  constexpr unsigned char even[12][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 0, 3 },
    { 1, 2, 0 }, { 1, 3, 2 }, { 2, 0, 1 }, { 2, 1, 3 }, { 2, 3, 0 }, { 3, 0, 2 }, { 3, 1, 0 },
    { 3, 2, 1 } };
  ProductSum<48, 212> determinant;
  for (const auto& [i, j, k] : even)
  {
    const BinaryNumber left = x[i] * y[j];
    const BinaryNumber right = -(x[j] * y[i]);
    for (const BinaryNumber& square : { x[k] * x[k], y[k] * y[k] })
    {
      determinant.add(left, square);
      determinant.add(right, square);
    }
  }
  return determinant.sign();
}

} // namespace

int inCircleExact(Point2 a, Point2 b, Point2 c, Point2 p)
{
  const ExactDifference differences[6] = { exactDifference(a.x, p.x), exactDifference(a.y, p.y),
    exactDifference(b.x, p.x), exactDifference(b.y, p.y), exactDifference(c.x, p.x),
    exactDifference(c.y, p.y) };
  BitSpan span;
  for (const ExactDifference& difference : differences)
  {
    span.include(difference);
  }
  if (!span.fits(63))
  {
    return inCircleAnyLength(a, b, c, p);
  }
  const double scale = span.scale();
  const InCircleIntegers integers = { scaledToInteger(differences[0], scale),
    scaledToInteger(differences[1], scale), scaledToInteger(differences[2], scale),
    scaledToInteger(differences[3], scale), scaledToInteger(differences[4], scale),
    scaledToInteger(differences[5], scale) };
  return span.fits(31) ? inCircleSign31(integers) : inCircleSign63(integers);
}

namespace
{

// A rectangle: the projection of a box along an axis.
struct Shadow
{
  Point2 Min;
  Point2 Max;
};

bool contains(const Shadow& box, Point2 p)
{
  return box.Min.x <= p.x && p.x <= box.Max.x && box.Min.y <= p.y && p.y <= box.Max.y;
}

// +1 or -1 if the rectangle lies strictly on that side of the directed line ab, else 0.
int strictSide(Point2 a, Point2 b, const Shadow& box)
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
bool edgeSeparates(Point2 a, Point2 b, const std::array<Point2, N>& others, const Shadow& box)
{
  const int side = strictSide(a, b, box);
  return side != 0 &&
    std::none_of(
      others.begin(), others.end(), [&](Point2 other) { return orientation(a, b, other) == side; });
}

// Tests the six edges of the tetrahedron, projected along one axis.
bool edgesSeparate(const std::array<Point2, 4>& p, const Shadow& box)
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
  const Point3 highest = { x > 0 ? box.Max[0] : box.Min[0], y > 0 ? box.Max[1] : box.Min[1],
    z > 0 ? box.Max[2] : box.Min[2] };
  const Point3 lowest = { x > 0 ? box.Min[0] : box.Max[0], y > 0 ? box.Min[1] : box.Max[1],
    z > 0 ? box.Min[2] : box.Max[2] };
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
  return !apartAlongAxis<4>({ p[0].x, p[1].x, p[2].x, p[3].x }, box.Min[0], box.Max[0]) &&
    !apartAlongAxis<4>({ p[0].y, p[1].y, p[2].y, p[3].y }, box.Min[1], box.Max[1]) &&
    !apartAlongAxis<4>({ p[0].z, p[1].z, p[2].z, p[3].z }, box.Min[2], box.Max[2]);
}

bool contains(const Box3& box, const Point3& p)
{
  return box.Min[0] <= p.x && p.x <= box.Max[0] && box.Min[1] <= p.y && p.y <= box.Max[1] &&
    box.Min[2] <= p.z && p.z <= box.Max[2];
}

} // namespace

bool triangleMeetsBox(Point2 a, Point2 b, Point2 c, const Box3& box)
{
  const Shadow shadow = { { box.Min[0], box.Min[1] }, { box.Max[0], box.Max[1] } };
  if (contains(shadow, a) || contains(shadow, b) || contains(shadow, c))
  {
    return true;
  }
  return !apartAlongAxis<3>({ a.x, b.x, c.x }, box.Min[0], box.Max[0]) &&
    !apartAlongAxis<3>({ a.y, b.y, c.y }, box.Min[1], box.Max[1]) &&
    !edgeSeparates<1>(a, b, { c }, shadow) && !edgeSeparates<1>(b, c, { a }, shadow) &&
    !edgeSeparates<1>(c, a, { b }, shadow);
}

bool tetrahedronMeetsBox(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Box3& box)
{
  const std::array<Point3, 4> p = { a, b, c, d };
  if (std::any_of(p.begin(), p.end(), [&](const Point3& corner) { return contains(box, corner); }))
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
    return Shadow{ { box.Min[first], box.Min[second] }, { box.Max[first], box.Max[second] } };
  };
  return !edgesSeparate(seen(&Point3::x, &Point3::y), shadow(0, 1)) &&
    !edgesSeparate(seen(&Point3::y, &Point3::z), shadow(1, 2)) &&
    !edgesSeparate(seen(&Point3::z, &Point3::x), shadow(2, 0));
}

} // namespace tipp
