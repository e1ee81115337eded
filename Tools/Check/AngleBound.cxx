// SPDX-License-Identifier: BSD-3-Clause
#include "Check/AngleBound.h"

#include "Check/ExactVector.h"

#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

namespace tipp
{
namespace check
{
namespace
{

/// Returns the number that a decimal text stands for.
mpq_class parseDecimal(const std::string& text)
{
  std::string digits = text;
  const std::size_t point = text.find('.');
  const std::size_t decimals = point == std::string::npos ? 0 : text.size() - point - 1;
  if (point != std::string::npos)
  {
    digits.erase(point, 1);
  }
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos)
  {
    throw std::invalid_argument(
      "the angle '" + text + "' is no number of degrees; give digits, such as 30 or 20.7.");
  }
  mpq_class number(mpz_class(digits, 10), mpz_class("1" + std::string(decimals, '0'), 10));
  number.canonicalize();
  return number;
}

/// Returns the squared cosine of an angle, below it or above it. `rounding`: MPFR_RNDD or
/// MPFR_RNDU.
mpq_class squaredCosine(const mpq_class& degrees, long bits, mpfr_rnd_t rounding)
{
  // The cosine falls from 0 to 90 degrees, so its lower bound is at the upper bound of the angle.
  const mpfr_rnd_t opposite = rounding == MPFR_RNDD ? MPFR_RNDU : MPFR_RNDD;
  constexpr unsigned long halfTurn = 180;
  mpfr_t x;
  mpfr_init2(x, bits);
  mpfr_const_pi(x, opposite);
  mpfr_mul_q(x, x, degrees.get_mpq_t(), opposite);
  mpfr_div_ui(x, x, halfTurn, opposite);
  mpfr_cos(x, x, rounding);
  mpfr_sqr(x, x, rounding);
  mpq_class square;
  mpfr_get_q(square.get_mpq_t(), x);
  mpfr_clear(x);
  return square;
}

constexpr long firstBits = 192;

} // namespace

AngleBound::AngleBound(const std::string& degrees)
  : Degrees(parseDecimal(degrees))
{
  constexpr int most = 60; // every triangle has an angle of at most 60 degrees
  if (this->Degrees > most)
  {
    throw std::invalid_argument("the angle " + degrees +
      " is above 60 degrees, which no triangle reaches at all corners; give a smaller one.");
  }
  this->Square = this->enclose(firstBits);
  this->RoundSquare = this->Square.Low.get_d();
}

/// By Niven's theorem (Irrational Numbers, 1956, corollary 3.12) the cosine of twice an angle of
/// rational degrees, and with it the squared cosine, is rational only for multiples of 30 and 45
/// degrees. Their squares are exact; all others are irrational.
AngleBound::Enclosure AngleBound::enclose(long bits) const
{
  constexpr std::array<std::array<int, 2>, 4> known{ { { 0, 4 }, { 30, 3 }, { 45, 2 },
    { 60, 1 } } };
  for (const auto& [degrees, quarters] : known)
  {
    if (this->Degrees == degrees)
    {
      mpq_class square(quarters, 4);
      square.canonicalize();
      return { square, square };
    }
  }
  return { squaredCosine(this->Degrees, bits, MPFR_RNDD),
    squaredCosine(this->Degrees, bits, MPFR_RNDU) };
}

/// For the vectors u and v from the apex, an angle below 90 degrees is below the bound if and only
/// if u.v > 0 and (u.v)^2 > c |u|^2 |v|^2, c being the squared cosine of the bound, which is at
/// least 1/4.
///
/// In doubles, with e = 2^-53: differences have a relative error of e, so u.v has an error of at
/// most 4.01 e |u| |v|, as |ux vx| + |uy vy| <= |u| |v|, and (u.v)^2 one of at most
/// 9.1 e |u|^2 |v|^2. c |u|^2 |v|^2 has a relative error of at most 12.1 e: 4 for each square, 1
/// for each of two products and 2 for c. Together this is less than 22 e |u|^2 |v|^2, and with the
/// error of that product itself less than 32 e = 2^-48 times its computed value. If u.v > 0 is
/// decided wrongly, |u.v| is at most 4.01 e |u| |v|, so the angle is not below the bound, and the
/// comparison says so. The squares' range excludes underflow and overflow.
bool AngleBound::isBelow(Position apex, Position p, Position q) const
{
  const double ux = p.x - apex.x;
  const double uy = p.y - apex.y;
  const double vx = q.x - apex.x;
  const double vy = q.y - apex.y;
  const double u = ux * ux + uy * uy;
  const double v = vx * vx + vy * vy;
  constexpr double least = 0x1p-450;
  constexpr double most = 0x1p450;
  if (!(std::min(u, v) >= least && std::max(u, v) <= most))
  {
    return this->isBelowExactly(apex, p, q);
  }
  const double dot = ux * vx + uy * vy;
  const double excess = dot * dot - this->RoundSquare * u * v;
  const double error = 0x1p-48 * u * v;
  return dot > 0 && (excess > error || (excess >= -error && this->isBelowExactly(apex, p, q)));
}

bool AngleBound::isBelowExactly(Position apex, Position p, Position q) const
{
  const ExactVector u(apex, p);
  const ExactVector v(apex, q);
  const mpq_class dot = u.dot(v);
  if (dot <= 0)
  {
    return false;
  }
  const mpq_class square = dot * dot;
  const mpq_class product = u.square() * v.square();
  Enclosure bound = this->Square;
  // The sides are rational: they equal a squared cosine only if that is rational, and then its
  // enclosure is one number. Otherwise more digits decide sooner or later.
  for (long bits = firstBits; square > bound.Low * product; bits *= 2)
  {
    if (square > bound.High * product)
    {
      return true;
    }
    bound = this->enclose(2 * bits);
  }
  return false;
}

} // namespace check
} // namespace tipp
