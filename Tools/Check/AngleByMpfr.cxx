// SPDX-License-Identifier: BSD-3-Clause
#include "Check/DecimalAngle.h"

#include <mpfr.h>

namespace tipp
{
namespace check
{
namespace
{

/// Returns the squared cosine of an angle, below it or above it. `rounding`: MPFR_RNDD or
/// MPFR_RNDU.
mpq_class roundedSquare(const mpq_class& degrees, long bits, mpfr_rnd_t rounding)
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

} // namespace

double Enclosure::roundLow() const
{
  return this->Low.get_d();
}

Enclosure DecimalAngle::encloseIrrational(long bits) const
{
  constexpr int decimal = 10;
  mpq_class degrees(mpz_class("0" + this->Whole + this->Fraction, decimal),
    mpz_class("1" + std::string(this->Fraction.size(), '0'), decimal));
  degrees.canonicalize();
  return { roundedSquare(degrees, bits, MPFR_RNDD), roundedSquare(degrees, bits, MPFR_RNDU) };
}

} // namespace check
} // namespace tipp
