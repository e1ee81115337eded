// SPDX-License-Identifier: BSD-3-Clause
#include "ScheduleTesting.h"

#include "Triangulation/PointsView.h"

#include <cmath>

namespace
{

using namespace tipp;
using namespace tipp::test;

const double NaN = std::nan("");

double factorFor(const Coordinates& xy)
{
  return withModerateMagnitude(view(xy), boundsOf(xy)).factor();
}

TEST(AreCollinear, UpToTwoPointsAre)
{
  EXPECT_TRUE(areCollinear(PointsView()));
  EXPECT_TRUE(areCollinear(view({ 1, 2 })));
  EXPECT_TRUE(areCollinear(view({ 1, 2, 3, -4 })));
}

TEST(AreCollinear, EqualPointsAre)
{
  EXPECT_TRUE(areCollinear(view({ 1, 2, 1, 2, 1, 2, 1, 2 })));
  EXPECT_TRUE(areCollinear(view({ 1, 2, 3, 4, 1, 2, 3, 4, 3, 4 })));
}

TEST(AreCollinear, PointsOnALineInAnyOrderAre)
{
  EXPECT_TRUE(areCollinear(view({ 3, 6, 1, 2, -5, -10, 0, 0, 100, 200 })));
}

TEST(AreCollinear, AnUlpOffTheLineIsNot)
{
  EXPECT_FALSE(areCollinear(view({ 0, 0, 1, 1, 0.5, std::nextafter(0.5, 1) })));
}

TEST(AreCollinear, TheLastPointDecides)
{
  Coordinates xy = makePointSet("collinear-in-order", 1000);
  ASSERT_TRUE(areCollinear(view(xy)));
  xy.insert(xy.end(), { 0.5, 1e9 });
  EXPECT_FALSE(areCollinear(view(xy)));
}

TEST(AreCollinear, ATriangleAfterEqualPointsIsNot)
{
  EXPECT_FALSE(areCollinear(view({ 1, 2, 1, 2, 3, 4, 1, 2, 3, 4, 3, 5 })));
}

TEST(AreCollinear, PointsThatAreNotFiniteDoNotCount)
{
  EXPECT_TRUE(areCollinear(view({ NaN, 0, 0, 0, 1, 1, HUGE_VAL, 5, 5, -HUGE_VAL, 2, 2 })));
  EXPECT_FALSE(areCollinear(view({ NaN, NaN, 0, 0, NaN, 1, 1, 1, 1, NaN, 2, 3 })));
  EXPECT_TRUE(areCollinear(view({ NaN, NaN, HUGE_VAL, 1, 2, NaN })));
}

TEST(ModerateMagnitude, OrdinaryCoordinatesStay)
{
  EXPECT_EQ(1, factorFor({ 0, 0, 1, 0, 0, 1 }));
  EXPECT_EQ(1, factorFor({ 1e12, 1e-12, -1e40, 3, 5, 1e50 }));
}

TEST(ModerateMagnitude, VerySmallCoordinatesAreScaledToAboutOne)
{
  const double factor = factorFor({ 0, 0, 3e-300, 0, 0, -5e-300 });
  EXPECT_LE(1, 5e-300 * factor);
  EXPECT_GT(2, 5e-300 * factor);
}

TEST(ModerateMagnitude, VeryLargeCoordinatesAreScaledToAboutOne)
{
  const double factor = factorFor({ 1e300, 0, -3e300, 2e299, 0, 1e300 });
  EXPECT_LE(1, 3e300 * factor);
  EXPECT_GT(2, 3e300 * factor);
}

TEST(ModerateMagnitude, FactorsArePowersOfTwo)
{
  for (const double size : { 1e-320, 1e-300, 1e-100, 1e100, 1e300, 1.7e308 })
  {
    int exponent = 0;
    EXPECT_EQ(0.5, std::frexp(factorFor({ 0, 0, size, 0, 0, size }), &exponent)) << size;
    EXPECT_NE(1, exponent) << size << " was not scaled";
  }
}

TEST(ModerateMagnitude, MixedMagnitudesStayIfDigitsWouldBeLost)
{
  EXPECT_EQ(1, factorFor({ 0, 0, 1e300, 0, 0, 1e-300 }));
  EXPECT_EQ(1, factorFor({ 1e300, 1e300, 4.9406564584124654e-324, 0, 0, 1 }));
}

TEST(ModerateMagnitude, MixedMagnitudesAreScaledIfNothingIsLost)
{
  EXPECT_NE(1, factorFor({ 0, 0, 1e300, 0, 0, 1e200 }));
}

TEST(ModerateMagnitude, RejectedPointsDoNotCount)
{
  EXPECT_NE(1, factorFor({ 0, 0, 1e300, 0, 0, 1e300, NaN, 1e-300, HUGE_VAL, 1 }));
}

TEST(ModerateMagnitude, AllZerosStay)
{
  EXPECT_EQ(1, factorFor({ 0, 0, 0, 0 }));
}

std::vector<std::pair<PointId, PointId>> duplicatesOf(const Coordinates& xy)
{
  std::vector<std::pair<PointId, PointId>> pairs;
  for (const Duplicate& duplicate : sortOutDuplicates(view(xy)))
  {
    pairs.emplace_back(duplicate.Point, duplicate.Representative);
  }
  return pairs;
}

using Pairs = std::vector<std::pair<PointId, PointId>>;

TEST(SortOutDuplicates, TheLowestIdRepresentsEqualPoints)
{
  EXPECT_EQ((Pairs{ { 2, 1 }, { 3, 0 }, { 5, 1 }, { 6, 0 } }),
    duplicatesOf({ 9, 9, 1, 1, 1, 1, 9, 9, 5, 5, 1, 1, 9, 9 }));
}

TEST(SortOutDuplicates, DistinctPointsHaveNone)
{
  EXPECT_TRUE(duplicatesOf({ 1, 2, 2, 1, 1, 3, 3, 1 }).empty());
}

TEST(SortOutDuplicates, PointsThatAreNotFiniteHaveNone)
{
  EXPECT_EQ(
    (Pairs{ { 4, 1 } }), duplicatesOf({ NaN, 0, 1, 1, NaN, 0, HUGE_VAL, 1, 1, 1, HUGE_VAL, 1 }));
}

TEST(SortOutDuplicates, ZerosOfEitherSignAreEqual)
{
  EXPECT_EQ((Pairs{ { 1, 0 }, { 2, 0 } }), duplicatesOf({ -0.0, 1, 0.0, 1, -0.0, 1 }));
}

} // namespace
