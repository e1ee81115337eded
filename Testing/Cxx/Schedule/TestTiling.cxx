// SPDX-License-Identifier: BSD-3-Clause
#include "ScheduleTesting.h"

#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace
{

using namespace tipp;
using namespace tipp::test;

double areaOf(const Box2& box)
{
  return (box.Max.x - box.Min.x) * (box.Max.y - box.Min.y);
}

/// Whether the boxes cover the domain, lie in it and share no area.
testing::AssertionResult tiles(const Tiling& tiling)
{
  const Box2& domain = tiling.domain();
  double area = 0;
  for (PartitionIndex i = 0; i < tiling.size(); ++i)
  {
    const Box2& a = tiling.box(i);
    if (!domain.contains(a.Min) || !domain.contains(a.Max) || a.Min.x > a.Max.x ||
      a.Min.y > a.Max.y)
    {
      return testing::AssertionFailure() << "box " << i << " is none of the domain";
    }
    area += areaOf(a);
    for (PartitionIndex j = 0; j < i; ++j)
    {
      const Box2& b = tiling.box(j);
      if (std::max(a.Min.x, b.Min.x) < std::min(a.Max.x, b.Max.x) &&
        std::max(a.Min.y, b.Min.y) < std::min(a.Max.y, b.Max.y))
      {
        return testing::AssertionFailure() << "boxes " << i << " and " << j << " overlap";
      }
    }
  }
  return std::fabs(area - areaOf(domain)) <= 1e-12 * areaOf(domain)
    ? testing::AssertionSuccess()
    : testing::AssertionFailure() << "areas sum up to " << area;
}

std::vector<Point2> somePoints(std::size_t count)
{
  return asPoints(makePointSet("uniform", count, 5));
}

Tiling unitBalanced(const std::vector<Point2>& sample, int count)
{
  return Tiling::balanced({ 0, 0, 1, 1 }, sample, count);
}

TEST(Tiling, AGridsBoxesTileTheDomain)
{
  for (const auto& [columns, rows] :
    { std::pair{ 1, 1 }, { 1, 7 }, { 5, 1 }, { 3, 4 }, { 16, 16 }, { 31, 2 } })
  {
    const Tiling tiling = Tiling::grid({ -0.1, 2.3, 5.7, 9.1 }, columns, rows);
    EXPECT_EQ(columns * rows, tiling.size());
    EXPECT_TRUE(tiles(tiling));
  }
}

TEST(Tiling, AGridsBoxesAreEqual)
{
  const Tiling tiling = Tiling::grid({ -1, 2, 5, 10 }, 6, 5);
  for (PartitionIndex i = 0; i < tiling.size(); ++i)
  {
    EXPECT_NEAR(1, tiling.box(i).Max.x - tiling.box(i).Min.x, 1e-14);
    EXPECT_NEAR(1.6, tiling.box(i).Max.y - tiling.box(i).Min.y, 1e-14);
  }
}

TEST(Tiling, TheBoxFoundForAPointContainsIt)
{
  const std::vector<Point2> points = somePoints(3000);
  for (const Tiling& tiling :
    { Tiling::grid({ 0, 0, 1, 1 }, 7, 5), unitBalanced(somePoints(500), 30) })
  {
    for (const Point2 p : points)
    {
      ASSERT_TRUE(tiling.box(tiling.locate(p)).contains(p));
    }
  }
}

TEST(Tiling, APointOnACutBelongsToTheUpperBox)
{
  const Tiling tiling = Tiling::grid({ 0, 0, 4, 4 }, 4, 4);
  for (double x = 0; x <= 4; ++x)
  {
    for (double y = 0; y <= 4; ++y)
    {
      const Box2& box = tiling.box(tiling.locate({ x, y }));
      EXPECT_EQ(std::min(x, 3.0), box.Min.x);
      EXPECT_EQ(std::min(y, 3.0), box.Min.y);
    }
  }
}

/// This is needed for artificial points, which have a partition too.
TEST(Tiling, APointOutsideTheDomainIsFoundInANearestBox)
{
  const Tiling tiling = Tiling::grid({ 0, 0, 4, 4 }, 4, 4);
  EXPECT_TRUE(tiling.box(tiling.locate({ -9, 1.5 })).contains(Point2{ 0, 1.5 }));
  EXPECT_TRUE(tiling.box(tiling.locate({ 2.5, 99 })).contains(Point2{ 2.5, 4 }));
  EXPECT_TRUE(tiling.box(tiling.locate({ 1e300, -1e300 })).contains(Point2{ 4, 0 }));
}

TEST(Tiling, OneBoxIsTheDomain)
{
  const Tiling tiling = Tiling::grid({ 1, 2, 3, 5 }, 1, 1);
  EXPECT_EQ(1, tiling.size());
  EXPECT_EQ(0, tiling.locate({ 2, 3 }));
  EXPECT_EQ(3, tiling.box(0).Max.x);
}

/// Fewer than 100 doubles lie between the bounds, so some boxes have no extent.
TEST(Tiling, MoreBoxesThanDoublesBetweenTheBoundsTileTheDomain)
{
  const double x = 1e12;
  const double far = x + 3 * 0x1p-13;
  const Tiling tiling = Tiling::grid({ x, 0, far, 1 }, 100, 1);
  EXPECT_EQ(100, tiling.size());
  EXPECT_TRUE(tiles(tiling));
  for (double at = x; at <= far; at = std::nextafter(at, HUGE_VAL))
  {
    EXPECT_TRUE(tiling.box(tiling.locate({ at, 0.5 })).contains(Point2{ at, 0.5 }));
  }
}

TEST(Tiling, ADomainAcrossAllDoublesIsCut)
{
  const double most = 1.7e308;
  const Tiling tiling = Tiling::grid({ -most, -most, most, most }, 4, 4);
  EXPECT_EQ(16, tiling.size());
  for (PartitionIndex i = 0; i < tiling.size(); ++i)
  {
    EXPECT_LT(tiling.box(i).Min.x, tiling.box(i).Max.x);
    EXPECT_LT(tiling.box(i).Min.y, tiling.box(i).Max.y);
  }
}

TEST(Tiling, BalancedBoxesTileTheDomain)
{
  for (const int count : { 1, 2, 3, 7, 64, 100 })
  {
    const Tiling tiling = unitBalanced(somePoints(6400), count);
    EXPECT_EQ(count, tiling.size());
    EXPECT_TRUE(tiles(tiling));
  }
}

TEST(Tiling, BalancedBoxesHoldEquallyManyPointsOfTheSample)
{
  const std::vector<Point2> sample = asPoints(makePointSet("clustered", 6400));
  const Tiling tiling = Tiling::balanced(boundsOf(makePointSet("clustered", 6400)), sample, 50);
  std::vector<int> counts(std::size_t(tiling.size()), 0);
  for (const Point2 p : sample)
  {
    ++counts[std::size_t(tiling.locate(p))];
  }
  EXPECT_LE(125, *std::min_element(counts.begin(), counts.end()));
  EXPECT_GE(131, *std::max_element(counts.begin(), counts.end()));
}

TEST(Tiling, EqualSamplePointsGiveNoMoreBoxesThanRequested)
{
  const std::vector<Point2> sample(1000, Point2{ 0.25, 0.75 });
  const Tiling tiling = unitBalanced(sample, 16);
  EXPECT_GE(16, tiling.size());
  EXPECT_TRUE(tiles(tiling));
  for (const Point2 p : somePoints(200))
  {
    EXPECT_TRUE(tiling.box(tiling.locate(p)).contains(p));
  }
}

TEST(Tiling, AFewIdenticalPointsGiveFewerBoxes)
{
  EXPECT_GE(5, unitBalanced(std::vector<Point2>(5, { 0.5, 0.5 }), 1000).size());
}

TEST(Tiling, ASampleSmallerThanTheCountGivesFewerBoxes)
{
  const Tiling tiling = unitBalanced(somePoints(10), 1000);
  EXPECT_GE(10, tiling.size());
  EXPECT_LE(2, tiling.size());
  EXPECT_TRUE(tiles(tiling));
}

TEST(Tiling, WithoutASampleThereIsOneBox)
{
  EXPECT_EQ(1, unitBalanced({}, 8).size());
}

void expectMetAsByBruteForce(const Tiling& tiling, Point2 a, Point2 b, Point2 c)
{
  if (orientation(a, b, c) < 0)
  {
    std::swap(b, c);
  }
  std::vector<PartitionIndex> expected;
  for (PartitionIndex i = 0; i < tiling.size(); ++i)
  {
    if (Circumdisk(a, b, c).meets(tiling.box(i)))
    {
      expected.push_back(i);
    }
  }
  std::vector<PartitionIndex> met;
  tiling.visitMet(Circumdisk(a, b, c), [&](PartitionIndex i) { met.push_back(i); });
  std::sort(met.begin(), met.end());
  ASSERT_EQ(expected, met);
}

TEST(Tiling, ADiskMeetsTheBoxesThatBruteForceFinds)
{
  const std::vector<Point2> points = somePoints(300);
  for (const Tiling& tiling :
    { Tiling::grid({ 0, 0, 1, 1 }, 9, 7), unitBalanced(somePoints(500), 40) })
  {
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    {
      // Triangles of all sizes around the first corner.
      const double size = std::ldexp(1.0, -int(i / 3 % 12));
      const auto near = [&](Point2 p) {
        return Point2{ points[i].x + size * (p.x - 0.5), points[i].y + size * (p.y - 0.5) };
      };
      expectMetAsByBruteForce(tiling, points[i], near(points[i + 1]), near(points[i + 2]));
    }
  }
}

TEST(Tiling, ASliversHugeDiskMeetsTheBoxesThatBruteForceFinds)
{
  std::mt19937_64 random(8);
  const Tiling tiling = Tiling::grid({ 0, 0, 1, 1 }, 8, 8);
  for (int i = 0; i < 200; ++i)
  {
    const Point2 a{ double(random() % 1024) / 1024, double(random() % 1024) / 1024 };
    const Point2 b{ double(random() % 1024) / 1024, double(random() % 1024) / 1024 };
    if (a == b)
    {
      continue;
    }
    const double middle = (a.x + b.x) / 2;
    const double off = std::ldexp(1.0, -int(random() % 53) - 1);
    const Point2 c{ middle, (a.y + b.y) / 2 + (i % 2 ? off : -off) };
    if (orientation(a, b, c) != 0)
    {
      expectMetAsByBruteForce(tiling, a, b, c);
    }
  }
}

/// The circle about (2, 2) touches cuts from one side, at lattice points.
TEST(Tiling, ADiskThatTouchesABoxMeetsIt)
{
  const Tiling tiling = Tiling::grid({ 0, 0, 4, 4 }, 4, 4);
  expectMetAsByBruteForce(tiling, { 2, 1 }, { 3, 2 }, { 1, 2 });
  std::vector<PartitionIndex> met;
  tiling.visitMet(
    Circumdisk({ 2, 1 }, { 3, 2 }, { 1, 2 }), [&](PartitionIndex i) { met.push_back(i); });
  // Four boxes share the disk. It touches two more on each side, at their common corner.
  EXPECT_EQ(12U, met.size());
}

TEST(Tiling, TooManyBoxesAreRefused)
{
  EXPECT_THROW(Tiling::grid({ 0, 0, 1, 1 }, 65536, 65536), std::length_error);
  EXPECT_THROW(Tiling::grid({ 0, 0, 1, 1 }, 1 << 24, 2), std::length_error);
}

TEST(PartitionSizes, APartitionBeyondTheKernelIsRefused)
{
  requireFitsKernel(100'000'000);
  EXPECT_THROW(requireFitsKernel(100'000'001), std::length_error);
}

} // namespace
