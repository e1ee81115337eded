// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFraction_h
#define tippFraction_h

#include "Predicates/Dyadic.h"

#include <utility>

namespace tipp
{

/// A quotient of dyadic rationals. The four operations are exact; the result is not reduced.
class Fraction
{
public:
  /// `value` must be finite.
  Fraction(double value = 0)
    : Numerator(value)
  {
  }

  friend Fraction operator+(const Fraction& a, const Fraction& b)
  {
    if (compare(a.Denominator, b.Denominator) == 0)
    {
      return { a.Numerator + b.Numerator, a.Denominator };
    }
    return { a.Numerator * b.Denominator + b.Numerator * a.Denominator,
      a.Denominator * b.Denominator };
  }
  friend Fraction operator-(const Fraction& a, const Fraction& b)
  {
    return a + Fraction(-b.Numerator, b.Denominator);
  }
  friend Fraction operator*(const Fraction& a, const Fraction& b)
  {
    return { a.Numerator * b.Numerator, a.Denominator * b.Denominator };
  }
  /// `b` must not be 0.
  friend Fraction operator/(const Fraction& a, const Fraction& b)
  {
    const bool isNegative = b.Numerator.sign() < 0;
    return { a.Numerator * (isNegative ? -b.Denominator : b.Denominator),
      a.Denominator * (isNegative ? -b.Numerator : b.Numerator) };
  }
  Fraction& operator+=(const Fraction& other) { return *this = *this + other; }

  /// The sign of a - b.
  friend int compare(const Fraction& a, const Fraction& b)
  {
    return compare(a.Numerator * b.Denominator, b.Numerator * a.Denominator);
  }
  friend bool operator<(const Fraction& a, const Fraction& b) { return compare(a, b) < 0; }
  friend bool operator<=(const Fraction& a, const Fraction& b) { return compare(a, b) <= 0; }
  friend bool operator>=(const Fraction& a, const Fraction& b) { return compare(a, b) >= 0; }

  /// The nearest double.
  double value() const { return nearestQuotient(this->Numerator, this->Denominator); }

  /// The double nearest to the square root of this number, which must not be negative.
  double root() const { return nearestRoot(this->Numerator, this->Denominator); }

private:
  Fraction(Dyadic numerator, Dyadic denominator)
    : Numerator(std::move(numerator))
    , Denominator(std::move(denominator))
  {
  }

  Dyadic Numerator;
  Dyadic Denominator = 1; ///< positive
};

} // namespace tipp

#endif
