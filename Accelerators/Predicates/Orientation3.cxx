// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Orientation3.h"

#include "Predicates/BitSpan.h"
#include "Predicates/CommonExponent.h"
#include "Predicates/ExactDifference.h"
#include "Predicates/Int256.h"

#include <array>

namespace tipp
{
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

} // namespace tipp
