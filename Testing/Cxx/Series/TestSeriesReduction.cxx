// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesReduction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace tipp;

namespace
{

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// What a reduction makes of the values of one sample.
float reduce(const std::string& text, const std::vector<double>& times, std::vector<float> values)
{
  SeriesReducer reducer(*SeriesReduction::parse(text), 3, times);
  for (std::size_t step = 0; step < values.size(); ++step)
  {
    const float samples[3] = { 100, values[step], -100 };
    reducer.add(step, samples, 0, 1);
    reducer.add(step, samples, 1, 3);
  }
  return reducer.result()[1];
}

const std::vector<double> hours = { 10, 11, 13, 17 };

} // namespace

TEST(SeriesReduction, FindsTheExtremesAmongTheSteps)
{
  EXPECT_EQ(7, reduce("max", hours, { 3, 7, none, 5 }));
  EXPECT_EQ(3, reduce("min", hours, { none, 7, 3, 5 }));
}

TEST(SeriesReduction, AveragesTheStepsThatHaveAValue)
{
  EXPECT_EQ(5, reduce("mean", hours, { 3, none, 7, 5 }));
}

TEST(SeriesReduction, CountsTheTimeOfTheFirstMaximumFromTheFirstStep)
{
  EXPECT_EQ(3, reduce("time-of-max", hours, { 3, none, 7, 7 }));
  EXPECT_EQ(0, reduce("time-of-max", hours, { -3, -4, -7, -7 }));
}

TEST(SeriesReduction, LetsAStepStandForHalfTheTimeToItsNeighbors)
{
  EXPECT_EQ(7, reduce("above:1", hours, { 2, 2, 2, 2 }));
  EXPECT_EQ(0.5, reduce("above:1", hours, { 2, 1, 1, none }));
  EXPECT_EQ(1.5, reduce("above:1", hours, { 1, 2, 1, none }));
  EXPECT_EQ(3, reduce("above:1", hours, { 1, 0, 2, 1 }));
  EXPECT_EQ(2, reduce("above:-1.5", hours, { -2, none, -2, 0 }));
  EXPECT_EQ(0, reduce("above:1", hours, { 1, 1, 1, 1 }));
}

TEST(SeriesReduction, HasNoResultWithoutAValue)
{
  for (const char* text : { "max", "min", "mean", "time-of-max", "above:1" })
  {
    EXPECT_TRUE(std::isnan(reduce(text, hours, { none, none, none, none }))) << text;
  }
}

TEST(SeriesReduction, OfASingleStepTakesNoTime)
{
  EXPECT_EQ(0, reduce("above:1", { 5 }, { 2 }));
  EXPECT_EQ(0, reduce("time-of-max", { 5 }, { 2 }));
  EXPECT_EQ(2, reduce("mean", { 5 }, { 2 }));
}

TEST(SeriesReduction, NamesItsField)
{
  const SeriesField level{ "zeta", "water level", "m", true };
  const SeriesField maximum =
    SeriesReduction::parse("max")->fieldOf(level, "hours since 2008-09-01");
  EXPECT_EQ("zeta_max", maximum.Name);
  EXPECT_EQ("maximum of water level", maximum.LongName);
  EXPECT_EQ("m", maximum.Units);
  EXPECT_FALSE(maximum.Varies);
  const SeriesField above =
    SeriesReduction::parse("above:0.25")->fieldOf(level, "hours since 2008-09-01");
  EXPECT_EQ("zeta_time_above_0.25", above.Name);
  EXPECT_EQ("hours", above.Units);
}

TEST(SeriesReduction, RefusesOtherWords)
{
  for (const char* text : { "", "median", "above", "above:", "above:x", "above:nan", "MAX" })
  {
    EXPECT_FALSE(SeriesReduction::parse(text)) << text;
  }
}
