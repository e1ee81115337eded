// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Dyadic.h"

#include "Predicates/ExactArithmetic.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

constexpr int DigitBits = 64;

std::uint64_t patternOf(double value)
{
  std::uint64_t pattern;
  std::memcpy(&pattern, &value, sizeof pattern);
  return pattern;
}

} // namespace

Dyadic::Dyadic(std::ptrdiff_t low, std::size_t count)
  : Heap(count > OwnCount ? new std::uint64_t[count] : nullptr)
  , Count(count)
  , Low(low)
{
}

Dyadic::Dyadic(const Dyadic& other)
  : Dyadic(other.Low, other.Count)
{
  this->Negative = other.Negative;
  std::copy_n(other.digits(), this->Count, this->digits());
}

void Dyadic::take(Dyadic& other) noexcept
{
  this->Heap = std::move(other.Heap);
  this->Count = std::exchange(other.Count, 0);
  this->Low = other.Low;
  this->Negative = other.Negative;
  if (!this->Heap)
  {
    std::copy_n(other.Own.begin(), this->Count, this->Own.begin());
  }
}

Dyadic::Dyadic(double value)
{
  const std::uint64_t pattern = patternOf(value);
  const int field = static_cast<int>(pattern >> 52) & 0x7ff;
  const std::uint64_t implicit = field != 0 ? std::uint64_t{ 1 } << 52 : 0;
  const std::uint64_t mantissa = (pattern & ((std::uint64_t{ 1 } << 52) - 1)) | implicit;
  // The mantissa counts 2^(field - 1075), for subnormal numbers 2^-1074. The offset of 17 digits
  // keeps the quotient positive.
  constexpr int offset = 17;
  const int position = std::max(field, 1) - 1075 + offset * DigitBits;
  const UInt128 shifted = static_cast<UInt128>(mantissa) << (position % DigitBits);
  const std::uint64_t digits[2] = { static_cast<std::uint64_t>(shifted),
    static_cast<std::uint64_t>(shifted >> DigitBits) };
  const int first = digits[0] == 0 ? 1 : 0;
  this->Low = position / DigitBits - offset + first;
  this->Own[0] = digits[first];
  this->Own[1] = digits[1];
  this->Count = static_cast<std::size_t>(2 - first);
  this->Negative = value < 0;
  this->trim();
}

void Dyadic::trim()
{
  while (this->Count > 0 && this->digits()[this->Count - 1] == 0)
  {
    --this->Count;
  }
}

Dyadic Dyadic::operator-() const
{
  Dyadic result = *this;
  result.Negative = !result.Negative;
  return result;
}

/// Whether the magnitude of a is less than that of b.
bool Dyadic::isShorter(const Dyadic& a, const Dyadic& b)
{
  if (a.high() != b.high())
  {
    return a.high() < b.high();
  }
  for (std::ptrdiff_t at = a.high() - 1; at >= std::min(a.Low, b.Low); --at)
  {
    if (a.digitAt(at) != b.digitAt(at))
    {
      return a.digitAt(at) < b.digitAt(at);
    }
  }
  return false;
}

Dyadic Dyadic::sum(const Dyadic& a, const Dyadic& b, bool isNegativeB)
{
  if (a.Count == 0 || b.Count == 0)
  {
    Dyadic result = a.Count == 0 ? b : a;
    result.Negative = a.Count == 0 ? isNegativeB : a.Negative;
    return result;
  }
  const bool isSwapped = isShorter(a, b);
  const Dyadic& large = isSwapped ? b : a;
  const Dyadic& small = isSwapped ? a : b;
  const bool isDifference = a.Negative != isNegativeB;
  const std::ptrdiff_t low = std::min(a.Low, b.Low);
  const std::size_t count = static_cast<std::size_t>(large.high() - low);
  Dyadic result(low, count + (isDifference ? 0 : 1));
  result.Negative = isSwapped ? isNegativeB : a.Negative;
  // In two's complement, a borrow is a carry of -1.
  Int128 carry = 0;
  std::uint64_t* digits = result.digits();
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::ptrdiff_t at = low + static_cast<std::ptrdiff_t>(i);
    const std::uint64_t term = at < small.high() ? small.digitAt(at) : 0;
    carry += large.digitAt(at);
    carry += isDifference ? -static_cast<Int128>(term) : static_cast<Int128>(term);
    digits[i] = static_cast<std::uint64_t>(carry);
    carry >>= DigitBits;
  }
  if (!isDifference)
  {
    digits[count] = static_cast<std::uint64_t>(carry);
  }
  result.trim();
  return result;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b)
{
  Dyadic result(a.Low + b.Low, a.Count + b.Count);
  result.Negative = a.Negative != b.Negative;
  std::uint64_t* digits = result.digits();
  std::fill_n(digits, result.Count, 0);
  for (std::size_t i = 0; i < a.Count; ++i)
  {
    UInt128 carry = 0;
    for (std::size_t j = 0; j < b.Count; ++j)
    {
      // (2^64 - 1)^2 + 2 (2^64 - 1) = 2^128 - 1: the product and two more digits fit.
      carry += static_cast<UInt128>(a.digits()[i]) * b.digits()[j];
      carry += digits[i + j];
      digits[i + j] = static_cast<std::uint64_t>(carry);
      carry >>= DigitBits;
    }
    digits[i + b.Count] = static_cast<std::uint64_t>(carry);
  }
  result.trim();
  return result;
}

ScaledDouble Dyadic::rounded() const
{
  if (this->Count == 0)
  {
    return { 0, 0 };
  }
  // The two highest digits have at least 65 significant bits.
  const double high = static_cast<double>(this->digitAt(this->high() - 1));
  const double low = static_cast<double>(this->digitAt(this->high() - 2));
  ScaledDouble result;
  result.Fraction = std::frexp(high + low * 0x1p-64, &result.Exponent);
  result.Fraction *= this->sign();
  result.Exponent += static_cast<int>(this->high() - 1) * DigitBits;
  return result;
}

namespace
{

/// Infinity stands for the first power of two that is not finite, as in IEEE 754's rounding.
Dyadic exactly(double value)
{
  return std::isinf(value) ? Dyadic(std::copysign(0x1p1023, value)) * Dyadic(2) : Dyadic(value);
}

/// Moves an estimate, a few roundings off, to the nearest double; ties go to the even one.
/// side(middle) returns the sign of (number - middle).
template <typename Side>
double nearestDouble(double estimate, const Side& side)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double largest = std::numeric_limits<double>::max();
  double nearest = std::clamp(estimate, -largest, largest);
  for (const double direction : { 1.0, -1.0 })
  {
    while (std::isfinite(nearest))
    {
      const double next = std::nextafter(nearest, direction * infinity);
      const double toNext = direction * side((exactly(nearest) + exactly(next)) * Dyadic(0.5));
      const bool isOdd = (patternOf(nearest) & 1) != 0;
      if (toNext < 0 || (toNext == 0 && !isOdd))
      {
        break;
      }
      nearest = next;
    }
  }
  return nearest;
}

} // namespace

double nearestQuotient(const Dyadic& numerator, const Dyadic& denominator)
{
  if (numerator.sign() == 0)
  {
    return 0;
  }
  const ScaledDouble a = numerator.rounded();
  const ScaledDouble b = denominator.rounded();
  return nearestDouble(std::ldexp(a.Fraction / b.Fraction, a.Exponent - b.Exponent),
    [&](const Dyadic& middle)
    { return (numerator - middle * denominator).sign() * denominator.sign(); });
}

double nearestRoot(const Dyadic& numerator, const Dyadic& denominator)
{
  if (numerator.sign() == 0)
  {
    return 0;
  }
  const ScaledDouble a = numerator.rounded();
  const ScaledDouble b = denominator.rounded();
  const int exponent = a.Exponent - b.Exponent;
  const int half = exponent >> 1;
  const double square = std::ldexp(a.Fraction / b.Fraction, exponent - 2 * half);
  return nearestDouble(std::ldexp(std::sqrt(square), half),
    [&](const Dyadic& middle)
    {
      // A root is above all negative numbers, whose squares tell nothing.
      return middle.sign() < 0
        ? 1
        : (numerator - middle * middle * denominator).sign() * denominator.sign();
    });
}

} // namespace tipp
