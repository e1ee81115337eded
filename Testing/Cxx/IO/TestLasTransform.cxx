// SPDX-License-Identifier: BSD-3-Clause
// The scale and offset with which LAS files store coordinates.
#include "Las/LasTransform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace
{

using namespace tipp;

AxisSurvey surveyOf(std::initializer_list<double> coordinates)
{
  AxisSurvey survey;
  for (const double coordinate : coordinates)
  {
    survey.add(coordinate);
  }
  return survey;
}

TEST(LasTransform, ScaleIsThatOfTheDecimals)
{
  EXPECT_EQ(0.01, surveyOf({ 3512345.25, 3512346.1 }).scale());
  EXPECT_EQ(1, surveyOf({ 7, 12 }).scale());
  EXPECT_EQ(0.1, surveyOf({ 0.1, 0.2, 0.7 }).scale());
  EXPECT_FALSE(surveyOf({ 0.1, 0.2, 0.7 }).isRounded());
}

TEST(LasTransform, TooManyDecimalsAreRounded)
{
  const AxisSurvey survey = surveyOf({ 0.123456789012, 1000 });
  EXPECT_EQ(1e-6, survey.scale()); // 1000 needs more than 32 bits at 1e-7
  EXPECT_TRUE(survey.isRounded());
}

TEST(LasTransform, CoordinatesThatAreNotFiniteDoNotCount)
{
  const AxisSurvey survey = surveyOf({ 1.5, INFINITY, 2.5, NAN });
  EXPECT_EQ(1.5, survey.low());
  EXPECT_EQ(2.5, survey.high());
  EXPECT_EQ(0.1, survey.scale());
  EXPECT_TRUE(surveyOf({ NAN }).isEmpty());
}

TEST(LasTransform, OffsetIsTheWantedOneIfTheRangeFits)
{
  const AxisSurvey survey = surveyOf({ 5000000.25, 5000100.5 });
  EXPECT_EQ(0.123, survey.offset(0.01, 0.123, false));
  // 5e6 / 1e-4 does not fit into 32 bits.
  const double offset = survey.offset(1e-4, 0, false);
  EXPECT_EQ(std::nearbyint(offset), offset);
  EXPECT_TRUE(survey.fits(1e-4, offset));
}

TEST(LasTransform, OffsetCanBeAMultipleOfTheScale)
{
  const AxisSurvey survey = surveyOf({ 1, 60 });
  EXPECT_EQ(0, survey.offset(1, 0.123, true));
  EXPECT_EQ(3, survey.offset(1.5, 3.1, true));
  EXPECT_EQ(0.3, survey.offset(0.1, 0.3, true)); // 0.3 / 0.1 is not 3 in doubles
}

} // namespace
