// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Circumball.h"

#include "ExactOracle.h"
#include "NearDegenerate.h"

#include "Predicates/ExactPredicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace
{

using tipp::Box2;
using tipp::Point2;

constexpr double Infinity = std::numeric_limits<double>::infinity();

// The disk of radius 5 around the origin.
const Point2 A{ 5, 0 };
const Point2 B{ -3, 4 };
const Point2 C{ 0, -5 };

double above(double value)
{
  return std::nextafter(value, Infinity);
}

double below(double value)
{
  return std::nextafter(value, -Infinity);
}

struct Counts
{
  int meets[2] = { 0, 0 };
  int inside[2] = { 0, 0 };
};

// A box with random sides, near the points, near the disk's bounds, or unbounded; each moved by a
// few ulps.
Box2 drawBox(NearDegenerate& draw, const NearDegenerate::Points& q, const Box2& bounds)
{
  const auto x = [&]() -> double
  {
    const double choices[] = { q[0].x, q[1].x, q[2].x, q[3].x, bounds.Min.x, bounds.Max.x,
      q[draw.integer(0, 3)].x + (q[0].x - q[1].x) * draw.real(-2, 2), -Infinity, Infinity };
    return choices[draw.integer(0, 8)];
  };
  const auto y = [&]() -> double
  {
    const double choices[] = { q[0].y, q[1].y, q[2].y, q[3].y, bounds.Min.y, bounds.Max.y,
      q[draw.integer(0, 3)].y + (q[0].y - q[1].y) * draw.real(-2, 2), -Infinity, Infinity };
    return choices[draw.integer(0, 8)];
  };
  const Point2 one = draw.nudged({ x(), y() });
  const Point2 two = draw.nudged({ x(), y() });
  return { std::min(one.x, two.x), std::min(one.y, two.y), std::max(one.x, two.x),
    std::max(one.y, two.y) };
}

template <typename Draw>
Counts compareWithRationals(NearDegenerate& draw, int count, Draw drawPoints)
{
  Counts counts;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i)
  {
    NearDegenerate::Points q = drawPoints();
    const int turn = tipp::orientation(q[0], q[1], q[2]);
    if (turn < 0)
    {
      std::swap(q[0], q[1]);
    }
    if (turn == 0)
    {
      continue;
    }
    const tipp::Circumdisk disk(q[0], q[1], q[2]);
    const oracle::Disk exact(q[0], q[1], q[2]);
    EXPECT_TRUE(exact.inside(disk.bounds())) << testing::PrintToString(q);
    for (int j = 0; j < 4; ++j)
    {
      const Box2 box = drawBox(draw, q, disk.bounds());
      // Skips boxes that begin at infinity and so contain no point.
      if (box.Min.x == Infinity || box.Min.y == Infinity || box.Max.x == -Infinity ||
        box.Max.y == -Infinity)
      {
        continue;
      }
      const bool meets = exact.meets(box);
      const bool inside = exact.inside(box);
      EXPECT_EQ(meets, disk.meets(box)) << testing::PrintToString(q) << testing::PrintToString(box);
      EXPECT_EQ(inside, disk.inside(box))
        << testing::PrintToString(q) << testing::PrintToString(box);
      ++counts.meets[meets ? 1 : 0];
      ++counts.inside[inside ? 1 : 0];
    }
  }
  return counts;
}

void expectAllAnswers(const Counts& counts)
{
  EXPECT_GT(counts.meets[0], 0);
  EXPECT_GT(counts.meets[1], 0);
  EXPECT_GT(counts.inside[0], 0);
  EXPECT_GT(counts.inside[1], 0);
}

} // namespace

TEST(Circumdisk, TouchingASideCountsAsMeeting)
{
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ 5, -1, 9, 1 }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).meets({ above(5), -1, 9, 1 }));
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ -1, -9, 1, -5 }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).meets({ -1, -9, 1, below(-5) }));
}

TEST(Circumdisk, TouchingACornerCountsAsMeeting)
{
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ 3, 4, 9, 9 }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).meets({ above(3), 4, 9, 9 }));
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ -9, -9, -4, -3 }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).meets({ -9, -9, -4, below(-3) }));
}

TEST(Circumdisk, TouchingFromInsideCountsAsInside)
{
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).inside({ -5, -5, 5, 5 }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).inside({ above(-5), -5, 5, 5 }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).inside({ -5, above(-5), 5, 5 }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).inside({ -5, -5, below(5), 5 }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).inside({ -5, -5, 5, below(5) }));
}

TEST(Circumdisk, ABoxWithinTheDiskAndADiskWithinTheBoxMeet)
{
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ -1, -1, 1, 1 }));
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ 0.5, 0.5, 0.5, 0.5 }));
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ -100, -100, 100, 100 }));
}

TEST(Circumdisk, UnboundedBoxes)
{
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).inside({ -Infinity, -Infinity, Infinity, Infinity }));
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ -Infinity, -Infinity, Infinity, Infinity }));
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).inside({ -5, -Infinity, Infinity, Infinity }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).inside({ above(-5), -Infinity, Infinity, Infinity }));
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ 5, -Infinity, Infinity, Infinity }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).meets({ above(5), -Infinity, Infinity, Infinity }));
  EXPECT_TRUE(tipp::Circumdisk(A, B, C).meets({ -Infinity, 4, -3, Infinity }));
  EXPECT_FALSE(tipp::Circumdisk(A, B, C).meets({ -Infinity, above(4), -3, Infinity }));
}

TEST(Circumdisk, BoundsAreTightForOrdinaryTriangles)
{
  const Box2 bounds = tipp::Circumdisk(A, B, C).bounds();
  EXPECT_NEAR(-5, bounds.Min.x, 1e-13);
  EXPECT_NEAR(-5, bounds.Min.y, 1e-13);
  EXPECT_NEAR(5, bounds.Max.x, 1e-13);
  EXPECT_NEAR(5, bounds.Max.y, 1e-13);
}

TEST(Circumdisk, BoundsAreInfiniteWhereDoublesCannotTell)
{
  const Box2 bounds = tipp::Circumdisk({ 0, 0 }, { 1e-200, 0 }, { 0, 1e-200 }).bounds();
  EXPECT_EQ(-Infinity, bounds.Min.x);
  EXPECT_EQ(Infinity, bounds.Max.y);
}

TEST(Circumdisk, ExactForLatticeTriangles)
{
  NearDegenerate draw(1);
  expectAllAnswers(compareWithRationals(draw, 10000,
    [&] {
      return draw.lattice(9, 1.0, { -4, 100 });
    }));
  expectAllAnswers(compareWithRationals(draw, 10000,
    [&] {
      return draw.lattice(9, 0.1, { 0, 0 });
    }));
}

TEST(Circumdisk, ExactForBoxesWithCornersByTheCircle)
{
  NearDegenerate draw(2);
  expectAllAnswers(compareWithRationals(draw, 10000,
    [&] {
      return draw.cocircular(0.1, { 0.5, -1 });
    }));
  expectAllAnswers(compareWithRationals(draw, 5000, [&] { return draw.unitCircle(); }));
}

TEST(Circumdisk, ExactForSliversWithEnormousDisks)
{
  NearDegenerate draw(3);
  expectAllAnswers(compareWithRationals(draw, 10000,
    [&] {
      return draw.collinear(0.1, { 0.3, -0.7 });
    }));
  expectAllAnswers(compareWithRationals(draw, 10000,
    [&] {
      return draw.collinear(1e-6, { 1e3, 7 });
    }));
}

TEST(Circumdisk, ExactBeyondTheRangeOfTheFilter)
{
  NearDegenerate draw(4);
  for (const int exponent : { -1035, -500, -240, -225, 225, 500, 1000 })
  {
    compareWithRationals(draw, 1000,
      [&] {
        return scaled(draw.cocircular(0.1, { 0.5, -1 }), exponent);
      });
  }
}

TEST(Circumdisk, ExactForMixedExponents)
{
  NearDegenerate draw(5);
  compareWithRationals(draw, 1000, [&] { return draw.mixedExponents(-1030, 990); });
  compareWithRationals(draw, 5000, [&] { return draw.mixedExponents(-30, 30); });
}
