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

BitSpan spanOf(ExactDifference first, ExactDifference second)
{
  BitSpan span;
  span.include(first.head);
  span.include(first.tail);
  span.include(second.head);
  span.include(second.tail);
  return span;
}

} // namespace

int orientationExact(Point2 a, Point2 b, Point2 c)
{
  const ExactDifference ux = exactDifference(a.x, c.x);
  const ExactDifference uy = exactDifference(a.y, c.y);
  const ExactDifference vx = exactDifference(b.x, c.x);
  const ExactDifference vy = exactDifference(b.y, c.y);
  const BitSpan x = spanOf(ux, vx);
  const BitSpan y = spanOf(uy, vy);
  if (!x.fits(63) || !y.fits(63))
  {
    return orientationAnyLength(a, b, c);
  }
  return orientationSign63(scaledToInteger(ux, x.scale()), scaledToInteger(uy, y.scale()),
    scaledToInteger(vx, x.scale()), scaledToInteger(vy, y.scale()));
}

namespace
{

// Each product has one difference of each axis, so each axis may have its own power of two.
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
      this->Span.include(value.head);
      this->Span.include(value.tail);
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
  // Most coplanar points are so along an axis: box borders and samples on them.
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
  // At least one digit more than a mantissa has.
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
    span.include(difference.head);
    span.include(difference.tail);
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

} // namespace tipp
