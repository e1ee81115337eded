// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{

constexpr long double pi = 3.14159265358979323846264338327950288L;

/// The distance from the exact value, in units of its last digit as a double.
double errorOf(double value, long double exact)
{
  const double rounded = std::fabs(double(exact));
  const double unit = std::nextafter(rounded, HUGE_VAL) - rounded;
  return double(std::fabs((long double)value - exact)) / unit;
}

TEST(Angles, OfVectorsAreWithinFourUnitsInTheLastDigit)
{
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> power(-30, 30);
  std::uniform_int_distribution<int> sign(0, 1);
  for (int i = 0; i < 200000; ++i)
  {
    const double x = std::exp2(power(random)) * (sign(random) == 0 ? 1 : -1);
    const double y =
      std::exp2(power(random) / (i % 2 == 0 ? 1 : 30)) * (sign(random) == 0 ? 1 : -1);
    const long double exact = std::atan2((long double)y, (long double)x) * 180 / pi;
    ASSERT_LE(errorOf(tipp::degreesOf(x, y), exact), 4) << x << ' ' << y;
  }
}

TEST(Angles, OfVectorsAlongAxesAndDiagonalsAreExact)
{
  EXPECT_EQ(0, tipp::degreesOf(2, 0));
  EXPECT_EQ(45, tipp::degreesOf(2, 2));
  EXPECT_EQ(90, tipp::degreesOf(0, 2));
  EXPECT_EQ(135, tipp::degreesOf(-2, 2));
  EXPECT_EQ(180, tipp::degreesOf(-2, 0));
  EXPECT_EQ(-180, tipp::degreesOf(-2, -0.0));
  EXPECT_EQ(-135, tipp::degreesOf(-2, -2));
  EXPECT_EQ(-90, tipp::degreesOf(0, -2));
  EXPECT_EQ(0, tipp::degreesOf(0, 0));
}

TEST(Angles, OfInfiniteVectorsAreThoseOfTheirLimits)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(90, tipp::degreesOf(1, infinity));
  EXPECT_EQ(45, tipp::degreesOf(infinity, infinity));
  EXPECT_EQ(0, tipp::degreesOf(infinity, 1));
  EXPECT_TRUE(std::isnan(tipp::degreesOf(std::nan(""), 1)));
  EXPECT_TRUE(std::isnan(tipp::degreesOf(1, std::nan(""))));
}

TEST(Angles, SineAndCosineAreWithinFourUnitsInTheLastDigit)
{
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> angle(-45, 45);
  for (int i = 0; i < 200000; ++i)
  {
    const double small = angle(random);
    const double degrees = small + 90 * (i % 17 - 8);
    const double rest = degrees - 90 * (i % 17 - 8); // as rounding left it
    const long double radians = (long double)rest * pi / 180;
    const long double sine = std::sin(radians);
    const long double cosine = std::cos(radians);
    const int quarter = (i % 17 + 8) % 4; // -8 and 8 quarters are none
    const long double sines[] = { sine, cosine, -sine, -cosine };
    ASSERT_LE(errorOf(tipp::sineOfDegrees(degrees), sines[quarter]), 4) << degrees;
    ASSERT_LE(errorOf(tipp::cosineOfDegrees(degrees), sines[(quarter + 1) % 4]), 4) << degrees;
  }
}

TEST(Angles, SineAndCosineOfQuartersAreExact)
{
  EXPECT_EQ(0, tipp::sineOfDegrees(0));
  EXPECT_EQ(1, tipp::sineOfDegrees(90));
  EXPECT_EQ(0, tipp::sineOfDegrees(180));
  EXPECT_EQ(-1, tipp::sineOfDegrees(-90));
  EXPECT_EQ(1, tipp::cosineOfDegrees(360));
  EXPECT_EQ(0, tipp::cosineOfDegrees(270));
  EXPECT_EQ(-1, tipp::cosineOfDegrees(-180));
  EXPECT_TRUE(std::isnan(tipp::sineOfDegrees(std::nan(""))));
  EXPECT_TRUE(std::isnan(tipp::cosineOfDegrees(std::numeric_limits<double>::infinity())));
}

} // namespace
