// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/SegmentCrossing.h"

#include "Predicates/CommonExponent.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tipp
{
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

} // namespace tipp
