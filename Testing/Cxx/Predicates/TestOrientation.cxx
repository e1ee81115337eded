// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactPredicates.h"

#include "ExactOracle.h"
#include "NearDegenerate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{

// How many results were right turns, collinear, and left turns.
using Answers = std::array<int, 3>;

// Compares orientation(), its exact path alone, and the result for the reversed triangle with
// rational arithmetic.
template <typename Draw>
Answers compareWithRationals(int count, Draw draw)
{
  Answers answers = {};
  for (int i = 0; i < count; ++i)
  {
    const NearDegenerate::Points q = draw();
    const int expected = oracle::orientation(q[0], q[1], q[2]);
    ++answers[expected + 1];
    EXPECT_EQ(expected, tipp::orientation(q[0], q[1], q[2])) << testing::PrintToString(q);
    EXPECT_EQ(expected, tipp::orientationExact(q[0], q[1], q[2])) << testing::PrintToString(q);
    EXPECT_EQ(-expected, tipp::orientation(q[2], q[1], q[0])) << testing::PrintToString(q);
    if (testing::Test::HasFailure())
    {
      break;
    }
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

TEST(Orientation, UlpBesideALineIsSeen)
{
  const tipp::Point2 b{ 12, 12 };
  const tipp::Point2 c{ 24, 24 };
  EXPECT_EQ(0, tipp::orientation({ 0.5, 0.5 }, b, c));
  EXPECT_EQ(-1, tipp::orientation({ std::nextafter(0.5, 1), 0.5 }, b, c));
}

TEST(Orientation, ExactOnALattice)
{
  NearDegenerate draw(1);
  expectAllAnswers(compareWithRationals(40000, [&] { return draw.lattice(7, 1.0, { -3, 1e6 }); }));
}

TEST(Orientation, ExactOnALatticeOfTenths)
{
  NearDegenerate draw(2);
  expectAllAnswers(compareWithRationals(40000, [&] { return draw.lattice(9, 0.1, { 0, 0 }); }));
  expectAllAnswers(compareWithRationals(20000,
    [&] {
      return draw.lattice(9, 0.1, { -1e5, 3e5 });
    }));
}

TEST(Orientation, ExactAnUlpBesideALine)
{
  NearDegenerate draw(3);
  expectAllAnswers(compareWithRationals(40000, [&] { return draw.collinear(0.1, { 0.3, -0.7 }); }));
  expectAllAnswers(compareWithRationals(20000,
    [&] {
      return draw.collinear(1e-9, { 1e3, 1e-3 });
    }));
}

TEST(Orientation, ExactWhereProductsUnderflow)
{
  NearDegenerate draw(4);
  expectAllAnswers(compareWithRationals(20000,
    [&] {
      return scaled(draw.collinear(0.1, { 0.3, -0.7 }), -540);
    }));
  expectAllAnswers(compareWithRationals(20000,
    [&] {
      return scaled(draw.collinear(0.1, { 0.3, 0 }), -1035);
    }));
}

TEST(Orientation, ExactWhereProductsOrDifferencesOverflow)
{
  NearDegenerate draw(5);
  expectAllAnswers(compareWithRationals(20000,
    [&] {
      return scaled(draw.collinear(0.1, { 0.3, -0.7 }), 560);
    }));
  expectAllAnswers(compareWithRationals(20000,
    [&] {
      return scaled(draw.collinear(0.1, { 0.3, 0 }), 1016);
    }));
}

TEST(Orientation, ExactForMixedExponents)
{
  NearDegenerate draw(6);
  compareWithRationals(20000, [&] { return draw.mixedExponents(-1030, 1000); });
  compareWithRationals(20000, [&] { return draw.mixedExponents(-40, 40); });
}

TEST(Orientation, ExactForTiesOfFewMagnitudesFarApart)
{
  NearDegenerate draw(7);
  expectAllAnswers(compareWithRationals(5000, [&] { return draw.fewMagnitudes(-1074, 1020); }));
  expectAllAnswers(compareWithRationals(20000, [&] { return draw.fewMagnitudes(-100, 100); }));
}
