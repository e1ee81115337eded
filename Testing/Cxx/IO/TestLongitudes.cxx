// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Points/Longitudes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{

using tipp::LongitudeSpan;

std::vector<double> wrapped(std::vector<double> xy, int top)
{
  tipp::wrapLongitudes("a.csv", top, xy);
  return xy;
}

/// The warning of points on the equator with these longitudes.
std::string warningOf(const std::vector<double>& longitudes, double factor = 1)
{
  LongitudeSpan span;
  for (const double x : longitudes)
  {
    span.add(factor * x, 0);
  }
  return span.warning();
}

std::vector<double> range(double first, double last)
{
  std::vector<double> values;
  for (double x = first; x <= last; x += 1)
  {
    values.push_back(x);
  }
  return values;
}

} // namespace

TEST(Longitudes, AreMovedBelowTheTop)
{
  EXPECT_EQ((std::vector<double>{ 170, -5, 190, 5, 0, 0, 180, 1, 0, 2 }),
    wrapped({ 170, -5, -170, 5, 0, 0, -180, 1, 360, 2 }, 360));
  EXPECT_EQ((std::vector<double>{ 170, -5, -170, 5, -180, 1, -180, 2 }),
    wrapped({ 170, -5, 190, 5, 180, 1, -180, 2 }, 180));
  EXPECT_EQ((std::vector<double>{ -170, 7 }), wrapped({ -170, 7 }, 0));
  EXPECT_EQ(0, wrapped({ -1e-20, 0 }, 360)[0]); // -1e-20 + 360 is rounded to 360
  EXPECT_TRUE(std::isnan(wrapped({ NAN, 1 }, 360)[0]));
  const std::vector<double> once = wrapped({ -0.1, 0, 359.9, 0, -359.9, 0 }, 360);
  EXPECT_EQ(once, wrapped(once, 360));
}

TEST(Longitudes, AreBetween360AndMinus360)
{
  tipp::test::expectIOError("a.csv", "x = 361, which is no longitude",
    [] {
      wrapped({ 361, 0 }, 360);
    });
}

TEST(LongitudeSpan, WarnsOfPointsOnBothSidesOfTheJump)
{
  EXPECT_NE(std::string::npos, warningOf({ 177, 179.5, -179, -178 }).find("--wrap 360"));
  std::vector<double> pacific = range(110, 180);
  for (const double x : range(-180, -70))
  {
    pacific.push_back(x);
  }
  EXPECT_NE(std::string::npos, warningOf(pacific).find("--wrap 360"));
  EXPECT_NE(std::string::npos, warningOf({ 350, 359, 1, 10 }).find("--wrap 180"));
}

TEST(LongitudeSpan, DoesNotWarnOfOtherPoints)
{
  EXPECT_EQ("", warningOf({}));
  EXPECT_EQ("", warningOf(range(-180, 180)));
  EXPECT_EQ("", warningOf(range(0, 360)));
  EXPECT_EQ("", warningOf(range(-100, 20)));
  EXPECT_EQ("", warningOf({ 170, 179.5, 181, 190 }));
  EXPECT_EQ("", warningOf({ 177, 179.5, -179, -178 }, 1000)); // metres
}

TEST(LongitudeSpan, JoinsThoseOfParts)
{
  LongitudeSpan west;
  west.add({ -179, 0, -178, 0 });
  LongitudeSpan east;
  east.add({ 178, 0, 179, 0, NAN, 0 });
  EXPECT_EQ("", west.warning() + east.warning());
  west.add(east);
  EXPECT_NE("", west.warning());
}
