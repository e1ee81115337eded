// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Tiling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace
{

using namespace tipp;

/// Random points inside and outside the domain, and points on and next to the sides and corners of
/// the boxes.
std::vector<Point2> pointsAround(const Tiling& tiling)
{
  std::mt19937_64 random(11);
  const Box2& domain = tiling.domain();
  const double width = domain.Max.x - domain.Min.x;
  const double height = domain.Max.y - domain.Min.y;
  std::vector<Point2> points;
  for (int i = 0; i < 2000; ++i)
  {
    const double u = double(random() % 3000) / 1000 - 1;
    const double v = double(random() % 3000) / 1000 - 1;
    points.push_back({ domain.Min.x + u * width, domain.Min.y + v * height });
  }
  for (PartitionIndex i = 0; i < tiling.size(); ++i)
  {
    const Box2& box = tiling.box(i);
    for (const double x : { box.Min.x, std::nextafter(box.Min.x, -HUGE_VAL), box.Max.x })
    {
      for (const double y : { box.Min.y, std::nextafter(box.Min.y, -HUGE_VAL), box.Max.y })
      {
        points.push_back({ x, y });
      }
    }
  }
  return points;
}

void expectSameAsOneByOne(const Tiling& tiling)
{
  std::vector<Point2> points = pointsAround(tiling);
  points.erase(std::remove_if(points.begin(), points.end(), [](Point2 p) { return !isFinite(p); }),
    points.end());
  std::vector<std::uint32_t> found(points.size());
  PartitionFinder(tiling).locate(points.data(), points.size(), found.data());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ASSERT_EQ(tiling.locate(points[i]), PartitionIndex(found[i]))
      << points[i].x << ' ' << points[i].y;
  }
}

std::vector<Point2> gathered(std::size_t count)
{
  std::vector<Point2> sample;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double scale = std::exp(-double(i % 12));
    sample.push_back({ 3 + scale * normal(random), -2 + scale * normal(random) });
  }
  return sample;
}

TEST(PartitionFinder, FindsManyPointsInAGridLikeSinglePoints)
{
  expectSameAsOneByOne(Tiling::grid({ 0, 0, 5, 3 }, 5, 3));
  expectSameAsOneByOne(Tiling::grid({ -0.1, 1e3, 0.7, 1e3 + 1e-9 }, 13, 7));
}

TEST(PartitionFinder, FindsManyPointsInBoxesOfAllSizesLikeSinglePoints)
{
  expectSameAsOneByOne(Tiling::balanced({ -10, -10, 10, 10 }, gathered(20000), 300));
}

TEST(PartitionFinder, FindsManyPointsInNestedTilingsLikeSinglePoints)
{
  const Tiling outer = Tiling::grid({ 0, 0, 4, 4 }, 2, 2);
  std::vector<Tiling> inner;
  for (PartitionIndex i = 0; i < outer.size(); ++i)
  {
    inner.push_back(Tiling::grid(outer.box(i), 1 + int(i), 3));
  }
  expectSameAsOneByOne(outer.refined(inner));
}

TEST(PartitionFinder, OneBoxHasAllPoints)
{
  expectSameAsOneByOne(Tiling::grid({ 1, 1, 2, 2 }, 1, 1));
}

TEST(PartitionFinder, AcceptsExtentsAtTheLimitsOfDoubles)
{
  constexpr double large = std::numeric_limits<double>::max();
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  expectSameAsOneByOne(Tiling::grid({ 0, 0, 8 * tiny, 3 }, 4, 4));
  expectSameAsOneByOne(Tiling::grid({ -large, -1, large, 1 }, 4, 4));
  expectSameAsOneByOne(Tiling::grid({ 1, 0, 1, 0 }, 1, 1));
}

TEST(PartitionFinder, PointsThatAreNotFiniteGetNoPartitionAndAreNotCounted)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const double xy[] = { 0.5, 0.5, nan, 0, 1.5, HUGE_VAL, 1.5, 0.5 };
  const Tiling tiling = Tiling::grid({ 0, 0, 2, 1 }, 2, 1);
  std::vector<std::uint32_t> labels(4);
  std::vector<std::size_t> counts(2);
  PartitionFinder(tiling).label(PointsView(xy, 4, 2), 0, 4, labels.data(), counts);
  const std::vector<std::uint32_t> expected = { 0, PartitionFinder::None, PartitionFinder::None,
    1 };
  EXPECT_EQ(expected, labels);
  EXPECT_EQ((std::vector<std::size_t>{ 1, 1 }), counts);
}

} // namespace
