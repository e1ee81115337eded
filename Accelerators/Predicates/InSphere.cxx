// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/InSphere.h"

#include "Predicates/ExactArithmetic.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tipp
{
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
  const std::array<mpz_class, 15> n = toCommonExponent<15>(
    { a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z, p.x, p.y, p.z });
  std::array<std::array<mpz_class, 3>, 4> u;
  std::array<mpz_class, 4> lift;
  for (std::size_t i = 0; i < 4; ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      u[i][k] = n[3 * i + k] - n[12 + k];
      lift[i] += u[i][k] * u[i][k];
    }
  }
  const auto volume = [&](std::size_t i, std::size_t j, std::size_t k) -> mpz_class
  {
    return u[i][2] * (u[j][0] * u[k][1] - u[k][0] * u[j][1]) +
      u[j][2] * (u[k][0] * u[i][1] - u[i][0] * u[k][1]) +
      u[k][2] * (u[i][0] * u[j][1] - u[j][0] * u[i][1]);
  };
  const mpz_class sum = lift[0] * volume(1, 2, 3) + lift[1] * volume(0, 3, 2) +
    lift[2] * volume(0, 1, 3) + lift[3] * volume(0, 2, 1);
  return sgn(sum);
}

} // namespace

int inSphereExact(
  const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& p)
{
  if (const int sign = signByPermanent(a, b, c, d, p))
  {
    return sign;
  }
  const std::array<const Point3*, 4> corners = { &a, &b, &c, &d };
  std::array<std::array<ExactDifference, 4>, 3> differences;
  BitSpan span;
  const auto include = [&](ExactDifference difference)
  {
    span.include(difference);
    return difference;
  };
  for (std::size_t i = 0; i < 4; ++i)
  {
    differences[0][i] = include(exactDifference(corners[i]->x, p.x));
    differences[1][i] = include(exactDifference(corners[i]->y, p.y));
    differences[2][i] = include(exactDifference(corners[i]->z, p.z));
  }
  if (!span.fits(63))
  {
    return inSphereAnyLength(a, b, c, d, p);
  }
  std::array<Differences, 3> integers;
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      integers[k][i] = scaledToInteger(differences[k][i], span.scale());
    }
  }
  return inSphereSign63(integers[0], integers[1], integers[2]);
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

} // namespace tipp
