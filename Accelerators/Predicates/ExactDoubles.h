// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactDoubles_h
#define tippExactDoubles_h

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tipp
{

/// head + tail equals the difference of two doubles exactly.
struct ExactDifference
{
  double head;
  double tail;
};

/// Knuth's two-sum as Two-Diff of Shewchuk 1997 (theorem 7). It holds for all finite operands whose
/// difference does not overflow: sums of doubles cannot underflow.
inline ExactDifference exactDifference(double x, double y)
{
  const double head = x - y;
  const double yVirtual = x - head;
  const double xVirtual = head + yVirtual;
  return { head, (x - xVirtual) + (yVirtual - y) };
}

/// The lowest and the highest binary digit of a set of doubles. With n = bits() and scale(), each
/// of them times scale() is an integer below 2^n in magnitude.
class BitSpan
{
public:
  void include(double value)
  {
    std::uint64_t pattern;
    std::memcpy(&pattern, &value, sizeof pattern);
    const int exponent = static_cast<int>(pattern >> 52) & 0x7ff;
    // The implicit bit bounds the count of trailing zeros by 52.
    const std::uint64_t mantissa = pattern | (std::uint64_t{ 1 } << 52);
    int low = exponent + __builtin_ctzll(mantissa);
    // Zero has no digit. Denormals get a position below all others: they have no scale.
    low = exponent != 0 ? low : (value != 0.0 ? Denormal : None);
    this->Low = low < this->Low ? low : this->Low;
    this->High = exponent > this->High ? exponent : this->High;
  }

  /// Whether the digits span at most `count` bits and the values can be scaled to integers without
  /// rounding.
  bool fits(int count) const { return this->bits() <= count && this->scalable(); }

  /// The number of bits from the lowest to the highest digit; not positive if all values are zero.
  int bits() const { return this->High + 53 - this->Low; }

  /// False if there are denormals, or if the scale would not be a normal number.
  bool scalable() const
  {
    return this->Low == None || (this->Low >= LowestField && this->High < 2046);
  }

  /// The power of two that scales the values to integers; scalable() must be true.
  double scale() const
  {
    // The lowest digit is 2^(Low - 1075); the exponent field of its reciprocal is 2098 - Low.
    const int field = this->Low == None ? 1023 : 2098 - this->Low;
    const std::uint64_t pattern = static_cast<std::uint64_t>(field) << 52;
    double result;
    std::memcpy(&result, &pattern, sizeof result);
    return result;
  }

private:
  static constexpr int None = 1 << 20;
  static constexpr int Denormal = -(1 << 20);
  static constexpr int LowestField = 52; // field 2046, the largest power of two

  int Low = None;
  int High = 0;
};

/// The difference in units of 1/scale, as an integer. Exact if scale comes from a BitSpan that
/// includes both parts of the difference and spans at most 63 bits.
inline std::int64_t scaledToInteger(ExactDifference difference, double scale)
{
  return static_cast<std::int64_t>(difference.head * scale) +
    static_cast<std::int64_t>(difference.tail * scale);
}

/// Multiplies finite doubles by one power of two that makes them all integers of arbitrary length.
/// Exact for every finite double; 1e-310 and 1e300 together take 2,000 bits. `exponent`, if not
/// null, receives the exponent of the integers' unit.
template <std::size_t N>
std::array<mpz_class, N> toCommonExponent(
  const std::array<double, N>& values, int* exponent = nullptr)
{
  constexpr int digits = 53;
  std::array<double, N> mantissas;
  std::array<int, N> exponents;
  int lowest = INT_MAX;
  for (std::size_t i = 0; i < N; ++i)
  {
    mantissas[i] = std::ldexp(std::frexp(values[i], &exponents[i]), digits);
    if (values[i] != 0.0)
    {
      lowest = std::min(lowest, exponents[i]);
    }
  }
  std::array<mpz_class, N> integers;
  for (std::size_t i = 0; i < N; ++i)
  {
    if (values[i] != 0.0)
    {
      integers[i] = mantissas[i];
      integers[i] <<= static_cast<mp_bitcnt_t>(exponents[i] - lowest);
    }
  }
  if (exponent)
  {
    *exponent = lowest == INT_MAX ? 0 : lowest - digits;
  }
  return integers;
}

} // namespace tipp

#endif
