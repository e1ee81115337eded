// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Decimal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace tipp;

TEST(Decimal, PositionsAreThoseOfTheWrittenNumbers)
{
  EXPECT_EQ(1.15, gridPosition(0, 0.1, 23)); // 11.5 * 0.1 is larger
  EXPECT_EQ(5000001.15, gridPosition(5e6, 0.1, 23));
  EXPECT_EQ(-0.05, gridPosition(0, 0.1, -1));
  EXPECT_EQ(0.333333, gridPosition(0, 0.333333, 2));
  EXPECT_EQ(0, gridPosition(0.3, -0.1, 6));
}

TEST(Decimal, CountsWholeSteps)
{
  EXPECT_EQ(3, stepsUpTo(0, 0.1, 0.3, 0)); // 0.3 / 0.1 is less than 3
  EXPECT_EQ(6, stepsUpTo(0.1, 0.1, 0.7, 0));
  EXPECT_EQ(2, stepsUpTo(0, 0.1, 0.29999999999999993, 0));
  EXPECT_EQ(3, stepsUpTo(0, 0.1, 0.29999999999999993, roundingOf(0.3)));
  EXPECT_EQ(-4, stepsUpTo(0, 0.1, -0.31, 0));
  EXPECT_EQ(-3, stepsToReach(0, 0.1, -0.31, 0));
  EXPECT_EQ(3, stepsToReach(0, 0.1, 0.3, 0));
  EXPECT_EQ(3, stepsToReach(0, 0.1, 0.30000000000000004, roundingOf(0.3)));
}

TEST(Decimal, PartsOfARangeAreRoundedOnce)
{
  EXPECT_EQ(0.1, partOfRange(0.1, 0.7, 6));
  EXPECT_EQ(0.01, partOfRange(500000.1, 500000.2, 10));
  EXPECT_EQ(1.0 / 3, partOfRange(0, 1, 3));
}

TEST(Decimal, StepsAreThoseOfTheWrittenNumbers)
{
  const GridSteps steps(0.05, 0.1);
  for (int i = 0; i < 1000; ++i)
  {
    EXPECT_EQ(gridPosition(0.05, 0.1, 2 * i), steps[i]);
  }
}

TEST(Decimal, NumbersWithManyDigitsOrDistantExponentsAreRounded)
{
  EXPECT_EQ(1e300, gridPosition(1e300, 1e-300, 2));
  EXPECT_EQ(0, stepsUpTo(1e300, 1, 1e300, 0));
  EXPECT_DOUBLE_EQ(2e300, GridSteps(0, 1e300)[2]);
  EXPECT_DOUBLE_EQ(0.1 + 2 * 0.12345678901234567, GridSteps(0.1, 0.12345678901234567)[2]);
  EXPECT_TRUE(std::isnan(gridPosition(std::nan(""), 1, 1)));
}

} // namespace
