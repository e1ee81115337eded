// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Report.h"

#include <gtest/gtest.h>

namespace
{

using tipp::TimeLeft;

TEST(TimeLeft, IsUnknownAtFirst)
{
  TimeLeft left;
  EXPECT_EQ("", left.update(0, 0));
  EXPECT_EQ("", left.update(0.5, 0.4));
  EXPECT_EQ("", left.update(0.01, 100));
  EXPECT_EQ("", left.update(1, 100));
}

TEST(TimeLeft, AssumesTheSpeedSoFar)
{
  TimeLeft left;
  left.update(0, 50);
  EXPECT_EQ("about 30 s left", left.update(0.25, 60));
  EXPECT_EQ("about 10 s left", left.update(0.75, 80));
}

TEST(TimeLeft, IgnoresWorkDoneBeforeTheStart)
{
  TimeLeft left;
  left.update(0.6, 0);
  EXPECT_EQ("about 30 s left", left.update(0.7, 10));
}

TEST(TimeLeft, HasMinutesAndHours)
{
  const auto after = [](double seconds)
  {
    TimeLeft left;
    left.update(0, 0);
    return left.update(0.5, seconds);
  };
  EXPECT_EQ("about 59 s left", after(58.5));
  EXPECT_EQ("about 2 min left", after(61));
  EXPECT_EQ("about 59 min left", after(3540));
  EXPECT_EQ("about 1 h 01 min left", after(3601));
  EXPECT_EQ("about 27 h 40 min left", after(27 * 3600 + 40 * 60));
}

} // namespace
