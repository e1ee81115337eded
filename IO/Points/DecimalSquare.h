// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDecimalSquare_h
#define tippDecimalSquare_h

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace tipp
{

__extension__ typedef __int128 WideInteger;

/// A double as the shortest decimal number that reads as it: the one that the user has written.
struct DecimalNumber
{
  WideInteger Digits; ///< a multiple of 10^Exponent
  int Exponent;

  explicit DecimalNumber(double value)
  {
    char text[32];
    const char* const end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr;
    this->Digits = 0;
    int places = 0;
    bool isFraction = false;
    const char* at = text + (*text == '-' ? 1 : 0);
    for (; at != end && *at != 'e'; ++at)
    {
      isFraction = isFraction || *at == '.';
      this->Digits = *at == '.' ? this->Digits : 10 * this->Digits + (*at - '0');
      places += isFraction && *at != '.' ? 1 : 0;
    }
    this->Digits = *text == '-' ? -this->Digits : this->Digits;
    this->Exponent = std::atoi(at + 1) - places;
  }
};

/// Numbers as multiples of a common power of ten. Empty if they differ so much in size that this
/// takes too many digits.
template <std::size_t Count>
std::optional<std::array<WideInteger, Count>> asMultiples(const std::array<double, Count>& values)
{
  int least = 0;
  for (std::size_t i = 0; i < Count; ++i)
  {
    const int exponent = DecimalNumber(values[i]).Exponent;
    least = i == 0 ? exponent : std::min(least, exponent);
  }
  std::array<WideInteger, Count> multiples;
  for (std::size_t i = 0; i < Count; ++i)
  {
    const DecimalNumber number(values[i]);
    constexpr int most = 20; // with 17 digits of a double fewer than the 38 of an integer
    if (number.Digits != 0 && number.Exponent - least > most)
    {
      return std::nullopt;
    }
    multiples[i] = number.Digits;
    for (int k = least; number.Digits != 0 && k < number.Exponent; ++k)
    {
      multiples[i] *= 10;
    }
  }
  return multiples;
}

/// Returns the index of the interval of length `side` that contains a coordinate: the quotient,
/// rounded down. A coordinate between two intervals is in the higher one, as the numbers are
/// written: 0.3 is in interval 3 of those of length 0.1.
inline double intervalOf(double value, double side)
{
  const double quotient = value / side;
  constexpr double rounding = 1e-14;
  if (std::fabs(quotient - std::nearbyint(quotient)) > rounding * (1 + std::fabs(quotient)))
  {
    return std::floor(quotient);
  }
  const auto exact = asMultiples<2>({ value, side });
  if (!exact)
  {
    return std::floor(quotient);
  }
  const auto [dividend, divisor] = *exact;
  return double(dividend / divisor - (dividend % divisor < 0 ? 1 : 0));
}

/// Returns the sign of p's distance from the centre of a square less q's, for points in this square
/// as their numbers are written. `square`: column and row, in a grid of squares of length `side`.
/// Returns 0 if the numbers have too many digits.
inline int compareDistances(const std::array<double, 2>& p, const std::array<double, 2>& q,
  const std::array<double, 2>& square, double side)
{
  constexpr double mostSquares = 1e15;
  WideInteger difference = 0;
  const auto exact = asMultiples<5>({ p[0], p[1], q[0], q[1], side });
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    if (!exact || std::fabs(square[axis]) > mostSquares)
    {
      return 0;
    }
    const WideInteger own = (*exact)[axis];
    const WideInteger other = (*exact)[2 + axis];
    const WideInteger centre = (2 * WideInteger(square[axis]) + 1) * (*exact)[4]; // twice
    // The difference of both squared distances along this axis.
    const WideInteger apart = own - other;
    const WideInteger sum = own + other - centre;
    constexpr WideInteger most = WideInteger(1) << 62; // products of these do not overflow
    if (apart > most || apart < -most || sum > most || sum < -most)
    {
      return 0;
    }
    difference += apart * sum;
  }
  return difference < 0 ? -1 : difference > 0 ? 1 : 0;
}

} // namespace tipp

#endif
