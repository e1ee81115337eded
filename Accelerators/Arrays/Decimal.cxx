// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Decimal.h"

#include "Arrays/ShortestText.h"
#include "Predicates/ExactArithmetic.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>

namespace tipp
{
namespace
{

/// The number Digits / 10^Places.
struct Decimal
{
  Int128 Digits = 0;
  int Places = 0;
};

/// Multiplies by a power of ten. Returns false if the result is too large.
bool scale(Int128& digits, int places)
{
  for (int i = 0; i < places; ++i)
  {
    if (digits == 0)
    {
      return true;
    }
    if (__builtin_mul_overflow(digits, Int128(10), &digits))
    {
      return false;
    }
  }
  return true;
}

/// Returns the shortest decimal number that is read as `value`.
std::optional<Decimal> decimalOf(double value)
{
  if (!std::isfinite(value))
  {
    return std::nullopt;
  }
  NumberText text;
  const char* const end = writeShortestScientific(text, std::fabs(value));
  Decimal decimal;
  bool isFraction = false;
  const char* at = text.data();
  for (; at < end && *at != 'e'; ++at)
  {
    if (*at == '.')
    {
      isFraction = true;
      continue;
    }
    decimal.Digits = 10 * decimal.Digits + (*at - '0');
    decimal.Places += isFraction ? 1 : 0;
  }
  decimal.Digits = std::signbit(value) ? -decimal.Digits : decimal.Digits;
  decimal.Places -= std::atoi(std::string(at + 1, end).c_str()); // has a sign, unlike from_chars
  if (decimal.Digits == 0)
  {
    return Decimal();
  }
  if (decimal.Places < 0)
  {
    if (!scale(decimal.Digits, -decimal.Places))
    {
      return std::nullopt;
    }
    decimal.Places = 0;
  }
  return decimal;
}

/// Numbers as whole multiples of one power of ten.
template <std::size_t N>
struct CommonDecimals
{
  std::array<Int128, N> Digits;
  int Places = 0;
};

template <std::size_t N>
std::optional<CommonDecimals<N>> commonDecimals(const std::array<double, N>& values)
{
  std::array<Decimal, N> decimals;
  CommonDecimals<N> common;
  for (std::size_t i = 0; i < N; ++i)
  {
    const std::optional<Decimal> decimal = decimalOf(values[i]);
    if (!decimal)
    {
      return std::nullopt;
    }
    decimals[i] = *decimal;
    common.Places = std::max(common.Places, decimal->Places);
  }
  for (std::size_t i = 0; i < N; ++i)
  {
    common.Digits[i] = decimals[i].Digits;
    if (!scale(common.Digits[i], common.Places - decimals[i].Places))
    {
      return std::nullopt;
    }
  }
  return common;
}

/// Returns digits / 10^places, correctly rounded.
double toDouble(Int128 digits, int places)
{
  std::string text;
  auto left = digits < 0 ? -UInt128(digits) : UInt128(digits);
  do
  {
    text.insert(text.begin(), static_cast<char>('0' + int(left % 10)));
    left /= 10;
  } while (left != 0);
  text += "e-" + std::to_string(places);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return digits < 0 ? -value : value;
}

/// Rounds down.
Int128 quotient(Int128 a, Int128 b)
{
  const Int128 toZero = a / b;
  return toZero - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

} // namespace

double gridPosition(double origin, double step, std::int64_t halves)
{
  const auto common = commonDecimals<2>({ origin, step });
  Int128 twice;
  Int128 way;
  Int128 digits;
  if (!common || __builtin_mul_overflow(common->Digits[0], Int128(2), &twice) ||
    __builtin_mul_overflow(common->Digits[1], Int128(halves), &way) ||
    __builtin_add_overflow(twice, way, &digits) ||
    __builtin_mul_overflow(digits, Int128(5), &digits))
  {
    return origin + 0.5 * double(halves) * step;
  }
  return toDouble(digits, common->Places + 1); // halves, hence 5 / 10
}

double stepsUpTo(double origin, double step, double v, double slack)
{
  const auto common = commonDecimals<3>({ origin, step, v });
  // In units of 10^-Places.
  const double most = common ? slack * std::pow(10.0, common->Places) : 0;
  Int128 way;
  if (!common || !(most < 0x1p120) ||
    __builtin_sub_overflow(common->Digits[2], common->Digits[0], &way) ||
    __builtin_add_overflow(way, Int128(most), &way))
  {
    return std::floor((v + slack - origin) / step);
  }
  return double(quotient(way, common->Digits[1]));
}

double partOfRange(double low, double high, int count)
{
  const auto common = commonDecimals<2>({ low, high });
  Int128 range;
  // Further digits for the quotient; more than 2 * 17 are too many for a range.
  constexpr int further = 20;
  if (!common || __builtin_sub_overflow(common->Digits[1], common->Digits[0], &range) ||
    !scale(range, further))
  {
    return (high - low) / count;
  }
  return toDouble(range / count, common->Places + further);
}

GridSteps::GridSteps(double origin, double step)
  : Start(origin)
  , Step(step)
  , Scale(1)
{
  constexpr int mostPlaces = 22; // larger powers of ten are no doubles
  constexpr Int128 most = Int128(1) << 53;
  const auto common = commonDecimals<2>({ origin, step });
  const auto isSmall = [](Int128 digits) { return -most <= digits && digits <= most; };
  if (common && common->Places <= mostPlaces && isSmall(common->Digits[0]) &&
    isSmall(common->Digits[1]))
  {
    this->Start = double(common->Digits[0]);
    this->Step = double(common->Digits[1]);
    for (int i = 0; i < common->Places; ++i)
    {
      this->Scale *= 10;
    }
  }
}

} // namespace tipp
