// SPDX-License-Identifier: BSD-3-Clause
// The squared cosine of an angle to many digits, for a checker without MPFR.
#include "Check/DecimalAngle.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace tipp
{
namespace check
{
namespace
{

/// Computes with numbers whose errors are a few units of 2^-Bits.
class FixedPoint
{
public:
  explicit FixedPoint(long bits)
    : Unit(std::ldexp(1.0, int(-bits)))
  {
    // Quotients are sums of doubles, of which the smallest is about 2^-1074.
    constexpr long most = 1000;
    if (bits > most)
    {
      throw std::runtime_error("an angle of the mesh is so near to the bound that 280 decimals do "
                               "not tell which is larger; give another bound.");
    }
  }

  /// numerator / denominator with an error below a unit.
  ExactNumber quotient(const ExactNumber& numerator, const ExactNumber& denominator) const
  {
    ExactNumber sum;
    for (ExactNumber rest = numerator; this->Unit * abs(denominator) < abs(rest);)
    {
      const ExactNumber next = nearestQuotient(rest, denominator);
      sum += next;
      rest = rest - next * denominator;
    }
    return sum;
  }

  /// The arc tangent of 1 / n, with an error below a unit for each term: fewer than 2^10.
  ExactNumber arcTangentOfInverse(double n) const
  {
    ExactNumber sum;
    ExactNumber power = n;
    double sign = 1;
    for (double odd = 1; this->Unit * power < ExactNumber(1.0); odd += 2)
    {
      sum += this->quotient(sign, power * ExactNumber(odd));
      power = power * ExactNumber(n * n);
      sign = -sign;
    }
    return sum;
  }

  /// By Machin's formula, with an error below 2^15 units.
  ExactNumber pi() const
  {
    constexpr double first = 5;
    constexpr double second = 239;
    return ExactNumber(16.0) * this->arcTangentOfInverse(first) -
      ExactNumber(4.0) * this->arcTangentOfInverse(second);
  }

  /// The cosine by its series, whose terms alternate and fall from the second on. `square`: that of
  /// the argument, up to 4.4. The error is below four times that of the square, and a few units
  /// for each term.
  ExactNumber cosineOfRoot(const ExactNumber& square) const
  {
    ExactNumber sum = 1.0;
    ExactNumber term = 1.0;
    for (double i = 1; this->Unit < abs(term); i += 2)
    {
      term = -this->quotient(term * square, ExactNumber(i * (i + 1)));
      sum += term;
    }
    return sum;
  }

private:
  ExactNumber Unit;
};

} // namespace

double Enclosure::roundLow() const
{
  const ScaledDouble low = this->Low.rounded();
  return std::ldexp(low.Fraction, low.Exponent);
}

/// The cosine's square is (1 + cos 2a) / 2. All errors together are below 2^30 units.
Enclosure DecimalAngle::encloseIrrational(long bits) const
{
  constexpr long guard = 64;
  constexpr long uncertain = 40;
  constexpr double decimal = 10;
  ExactNumber degrees;
  ExactNumber denominator = 90.0;
  for (const char digit : this->Whole + this->Fraction)
  {
    degrees = degrees * ExactNumber(decimal) + ExactNumber(double(digit - '0'));
  }
  for (std::size_t i = 0; i < this->Fraction.size(); ++i)
  {
    denominator = denominator * ExactNumber(decimal);
  }
  const FixedPoint fixed(bits + guard);
  const ExactNumber pi = fixed.pi();
  const ExactNumber twice = fixed.quotient(pi * degrees, denominator);
  const ExactNumber cosine = fixed.cosineOfRoot(fixed.quotient(twice * twice, 1.0));
  const ExactNumber square = ExactNumber(0.5) + ExactNumber(0.5) * cosine;
  const ExactNumber error = std::ldexp(1.0, int(uncertain - guard - bits));
  return { square - error, square + error };
}

} // namespace check
} // namespace tipp
