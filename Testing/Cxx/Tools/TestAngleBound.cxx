// SPDX-License-Identifier: BSD-3-Clause
#include "Check/AngleBound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace
{

using tipp::check::AngleBound;
using tipp::check::Position;

/// Returns whether half a square, whose angles are 45, 45 and 90 degrees, misses a bound.
bool isHalfSquareBelow(const std::string& degrees, double side = 1)
{
  return AngleBound(degrees).isMissedBy({ 0, 0 }, { side, 0 }, { side, side });
}

TEST(AngleBound, IsMetByAnEqualAngle)
{
  EXPECT_FALSE(isHalfSquareBelow("45"));
  EXPECT_FALSE(isHalfSquareBelow("045.000"));
}

TEST(AngleBound, TellsAnglesApartThatDoublesCannot)
{
  const std::string zeros(80, '0');
  EXPECT_TRUE(isHalfSquareBelow("45." + zeros + "1"));
  EXPECT_FALSE(isHalfSquareBelow("44." + std::string(80, '9')));
}

TEST(AngleBound, HoldsForTinyAndHugeTriangles)
{
  for (const double side : { 0x1p-1000, 0x1p-500, 0x1p500, 0x1p1000 })
  {
    EXPECT_FALSE(isHalfSquareBelow("45", side)) << side;
    EXPECT_TRUE(isHalfSquareBelow("45.0000000000000001", side)) << side;
  }
}

/// The height makes the angle 30 degrees except for rounding; the next doubles are on both sides.
TEST(AngleBound, DecidesBesideThirtyDegrees)
{
  const AngleBound bound("30");
  const double height = std::sqrt(1.0 / 3);
  const Position apex{ 1, std::nextafter(height, 1) };
  EXPECT_FALSE(bound.isMissedBy({ 0, 0 }, { 1, 0 }, apex));
  const Position lower{ 1, std::nextafter(height, 0) };
  EXPECT_TRUE(bound.isMissedBy({ 0, 0 }, { 1, 0 }, lower));
}

TEST(AngleBound, LooksAtAllCorners)
{
  const AngleBound bound("20.7");
  const Position a{ 0, 0 };
  const Position b{ 10, 0 };
  const Position c{ 5, 1 };
  EXPECT_TRUE(bound.isMissedBy(a, b, c));
  EXPECT_TRUE(bound.isMissedBy(b, c, a));
  EXPECT_TRUE(bound.isMissedBy(c, a, b));
}

TEST(AngleBound, ZeroIsMetByAll)
{
  EXPECT_FALSE(AngleBound("0").isMissedBy({ 0, 0 }, { 1e9, 0 }, { 1e9, 1e-9 }));
}

TEST(AngleBound, RefusesOtherTexts)
{
  for (const char* text : { "", ".", "-1", "1e1", "0x10", "30 ", "3.0.1", "nan", "60.1", "90" })
  {
    EXPECT_THROW(AngleBound bound(text), std::invalid_argument) << text;
  }
}

} // namespace
