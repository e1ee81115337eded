// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactPredicates.h"

#include "ExactOracle.h"
#include "NearDegenerate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace
{

// How many results were outside, on the circle, and inside.
using Answers = std::array<int, 3>;

// Compares inCircle(), and its exact path alone, with rational arithmetic. Triangles are made
// counter-clockwise first; collinear draws are skipped.
template <typename Draw>
Answers compareWithRationals(int count, Draw draw)
{
  Answers answers = {};
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i)
  {
    NearDegenerate::Points q = draw();
    const int turn = tipp::orientation(q[0], q[1], q[2]);
    if (turn == 0)
    {
      continue;
    }
    if (turn < 0)
    {
      std::swap(q[0], q[1]);
    }
    const int expected = oracle::inCircle(q[0], q[1], q[2], q[3]);
    ++answers[expected + 1];
    EXPECT_EQ(expected, tipp::inCircle(q[0], q[1], q[2], q[3])) << testing::PrintToString(q);
    EXPECT_EQ(expected, tipp::inCircleExact(q[0], q[1], q[2], q[3])) << testing::PrintToString(q);
  }
  return answers;
}

void expectAllAnswers(const Answers& answers)
{
  EXPECT_GT(answers[0], 0);
  EXPECT_GT(answers[1], 0);
  EXPECT_GT(answers[2], 0);
}

} // namespace

TEST(InCircle, UlpBesideACircleIsSeen)
{
  const tipp::Point2 a{ 5, 0 };
  const tipp::Point2 b{ 0, 5 };
  const tipp::Point2 c{ -4, 3 };
  EXPECT_EQ(0, tipp::inCircle(a, b, c, { 3, -4 }));
  EXPECT_EQ(1, tipp::inCircle(a, b, c, { std::nextafter(3, 0), -4 }));
  EXPECT_EQ(-1, tipp::inCircle(a, b, c, { std::nextafter(3, 4), -4 }));
}

TEST(InCircle, ExactOnALattice)
{
  NearDegenerate draw(1);
  expectAllAnswers(compareWithRationals(30000, [&] { return draw.lattice(7, 1.0, { -3, 1e6 }); }));
}

TEST(InCircle, ExactOnALatticeOfTenths)
{
  NearDegenerate draw(2);
  expectAllAnswers(compareWithRationals(30000, [&] { return draw.lattice(5, 0.1, { 0, 0 }); }));
  expectAllAnswers(compareWithRationals(20000,
    [&] {
      return draw.lattice(5, 0.1, { -1e5, 3e5 });
    }));
}

TEST(InCircle, ExactAnUlpBesideACircle)
{
  NearDegenerate draw(3);
  expectAllAnswers(compareWithRationals(30000, [&] { return draw.cocircular(0.1, { 0.3, -7 }); }));
  expectAllAnswers(compareWithRationals(10000, [&] { return draw.cocircular(1e-9, { 1e3, 1 }); }));
}

TEST(InCircle, ExactForPointsOfACircleWithAllDigits)
{
  NearDegenerate draw(4);
  const Answers answers = compareWithRationals(20000, [&] { return draw.unitCircle(); });
  EXPECT_GT(answers[0], 0);
  EXPECT_GT(answers[2], 0);
}

TEST(InCircle, ExactForAlmostCollinearPoints)
{
  NearDegenerate draw(5);
  expectAllAnswers(compareWithRationals(30000, [&] { return draw.collinear(0.1, { 0.3, -7 }); }));
}

TEST(InCircle, ExactWhereTheDeterminantUnderflows)
{
  NearDegenerate draw(6);
  for (const int exponent : { -240, -270, -300, -520, -545, -1035 })
  {
    expectAllAnswers(compareWithRationals(3000,
      [&] {
        return scaled(draw.cocircular(0.1, { 0.3, 0 }), exponent);
      }));
  }
}

TEST(InCircle, ExactWhereTheDeterminantOverflows)
{
  NearDegenerate draw(7);
  for (const int exponent : { 250, 256, 262, 340, 510, 1014, 1017 })
  {
    expectAllAnswers(compareWithRationals(3000,
      [&] {
        return scaled(draw.cocircular(0.1, { 0.3, 0 }), exponent);
      }));
  }
}

TEST(InCircle, ExactWhereOneTermOverflowsAndItsOppositesDoNot)
{
  NearDegenerate draw(9);
  expectAllAnswers(compareWithRationals(60000,
    [&] {
      return scaled(draw.cocircular(draw.real(0.5, 1), { 0, 0 }), draw.integer(249, 255));
    }));
}

TEST(InCircle, ExactForMixedExponents)
{
  NearDegenerate draw(8);
  compareWithRationals(4000, [&] { return draw.mixedExponents(-1030, 1000); });
  compareWithRationals(20000, [&] { return draw.mixedExponents(-40, 40); });
}

TEST(InCircle, ExactForTiesOfFewMagnitudesFarApart)
{
  NearDegenerate draw(10);
  expectAllAnswers(compareWithRationals(3000, [&] { return draw.fewMagnitudes(-1074, 1020); }));
  expectAllAnswers(compareWithRationals(20000, [&] { return draw.fewMagnitudes(-100, 100); }));
}

TEST(InCircle, ExactForADenormalBesideLargeNumbers)
{
  const double denormal = 4.9406564584124654e-324;
  const tipp::Point2 a{ 0, 0 };
  const tipp::Point2 b{ 1e300, 0 };
  const tipp::Point2 c{ 1e300, 1e300 };
  EXPECT_EQ(0, tipp::inCircle(a, b, c, { 0, 1e300 }));
  EXPECT_EQ(1, tipp::inCircle(a, b, c, { denormal, 1e300 }));
  EXPECT_EQ(-1, tipp::inCircle(a, b, c, { -denormal, 1e300 }));
}
