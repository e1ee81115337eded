// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tipp
{
namespace
{

constexpr double radiansPerDegree = 3.14159265358979323846 / 180;
constexpr double degreesPerRadian = 180 / 3.14159265358979323846;

/// Returns the Taylor series 1 + x (1 + x (1 + ...) / divisors[1]) / divisors[0].
template <std::size_t N>
double nestedSeries(double x, const std::array<double, N>& divisors)
{
  double sum = 1;
  for (std::size_t i = N; i-- > 0;)
  {
    sum = 1 + x * sum / divisors[i];
  }
  return sum;
}

/// The sine of up to 45 degrees; the first term left out, x^19 / 19!, is below 2^-63.
double sineOfSmall(double degrees)
{
  const double x = degrees * radiansPerDegree;
  return x *
    nestedSeries<8>(-x * x, { 2 * 3, 4 * 5, 6 * 7, 8 * 9, 10 * 11, 12 * 13, 14 * 15, 16 * 17 });
}

/// The cosine of up to 45 degrees; the first term left out, x^18 / 18!, is below 2^-58.
double cosineOfSmall(double degrees)
{
  const double x = degrees * radiansPerDegree;
  return nestedSeries<8>(-x * x, { 1 * 2, 3 * 4, 5 * 6, 7 * 8, 9 * 10, 11 * 12, 13 * 14, 15 * 16 });
}

/// The arctangent of a number from 0 to 1 in degrees: that of the nearest sixteenth, which is
/// known, and by the addition theorem that of the rest, of up to 1/32. The first term left out of
/// its series, x^13 / 13, is below 2^-68.
double arctangent(double x)
{
  constexpr std::array<double, 17> known = { 0, 3.5763343749973510307, 7.1250163489017975620,
    10.619655276155134554, 14.036243467926478583, 17.354024636261322009, 20.556045219583464308,
    23.629377730656816642, 26.565051177077989352, 29.357753542791272457, 32.005383208083495561,
    34.508522987668401316, 36.869897645844021297, 39.093858886229500120, 41.185925165709645805,
    43.152389734005404305, 45 };
  const auto nearest = std::size_t(16 * x + 0.5);
  const double sixteenth = double(nearest) / 16;
  const double rest = (x - sixteenth) / (1 + x * sixteenth);
  const double square = -rest * rest;
  double sum = 1.0 / 11;
  for (const double divisor : { 9.0, 7.0, 5.0, 3.0, 1.0 })
  {
    sum = 1 / divisor + square * sum;
  }
  return known[nearest] + degreesPerRadian * (rest * sum);
}

} // namespace

double sineOfDegrees(double degrees)
{
  int quarters = 0;
  const double small = std::remquo(degrees, 90, &quarters); // exact
  const double value = quarters % 2 == 0 ? sineOfSmall(small) : cosineOfSmall(small);
  return (quarters & 2) != 0 ? -value : value;
}

double cosineOfDegrees(double degrees)
{
  int quarters = 0;
  const double small = std::remquo(degrees, 90, &quarters); // exact
  const double value = quarters % 2 == 0 ? cosineOfSmall(small) : sineOfSmall(small);
  return ((quarters + 1) & 2) != 0 ? -value : value;
}

double degreesOf(double x, double y)
{
  if (std::isnan(x) || std::isnan(y))
  {
    return x + y;
  }
  const double width = std::fabs(x);
  const double height = std::fabs(y);
  const double longer = std::max(width, height);
  const double shorter = std::min(width, height);
  const double ratio = longer == 0 ? 0 : longer == shorter ? 1 : shorter / longer;
  const double flat = arctangent(ratio);
  const double first = height > width ? 90 - flat : flat;
  return std::copysign(std::signbit(x) ? 180 - first : first, y);
}

} // namespace tipp
