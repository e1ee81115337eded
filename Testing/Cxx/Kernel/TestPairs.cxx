// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/Pairs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace tipp;

TEST(Pairs, MagnitudeDropsTheSignOfEachLane)
{
  const Pair a = magnitude(Pair{ -2.5, 3 });
  EXPECT_EQ(2.5, a[0]);
  EXPECT_EQ(3, a[1]);
  const Pair b = magnitude(Pair{ -0.0, -HUGE_VAL });
  EXPECT_FALSE(std::signbit(b[0]));
  EXPECT_EQ(HUGE_VAL, b[1]);
}

TEST(Pairs, TheBitsShowWhichComparisonsHold)
{
  const Pair zero{ 0, 0 };
  EXPECT_EQ(0U, bitsOf(Pair{ -1, -1 } > zero));
  EXPECT_EQ(1U, bitsOf(Pair{ 1, -1 } > zero));
  EXPECT_EQ(2U, bitsOf(Pair{ -1, 1 } > zero));
  EXPECT_EQ(3U, bitsOf(Pair{ 1, 1 } > zero));
}

/// The filters rely on this: after an overflow, no comparison decides.
TEST(Pairs, AComparisonWithNaNFails)
{
  const Pair nan{ std::nan(""), std::nan("") };
  EXPECT_EQ(0U, bitsOf(nan > Pair{ 0, 0 }));
  EXPECT_EQ(0U, bitsOf(-nan > Pair{ 0, 0 }));
  EXPECT_EQ(0U, bitsOf(Pair{ 1, 1 } > nan));
}

TEST(Pairs, LowTakesTheFirstLanesAndHighTheSecond)
{
  const Pair a{ 1, 2 };
  const Pair b{ 3, 4 };
  EXPECT_EQ(1, low(a, b)[0]);
  EXPECT_EQ(3, low(a, b)[1]);
  EXPECT_EQ(2, high(a, b)[0]);
  EXPECT_EQ(4, high(a, b)[1]);
}

} // namespace
