// SPDX-License-Identifier: BSD-3-Clause
// Lists of the segments near each partition.
#include "Constraints/Insertion/PartitionSegments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace
{

using namespace tipp;

constexpr std::size_t PointCount = 500;

std::vector<Point2> randomPoints(std::size_t count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Point2> points(count);
  for (Point2& p : points)
  {
    p = { coordinate(random), coordinate(random) };
  }
  return points;
}

/// Short and long segments between points.
std::vector<IdSegment> randomSegments(std::size_t points)
{
  std::mt19937 random(7);
  std::vector<IdSegment> segments;
  for (std::int64_t i = 0; i < 2000; ++i)
  {
    const auto a = PointId(random() % points);
    segments.push_back({ a, PointId((std::size_t(a) + 1 + random() % (points - 1)) % points), i });
  }
  return segments;
}

bool isNear(const PartitionSegments& near, PartitionIndex partition, std::int64_t segment)
{
  return std::binary_search(near.begin(partition), near.end(partition), segment);
}

TEST(PartitionSegments, OfAPartitionAreAllThatMeetIt)
{
  std::vector<Point2> all = randomPoints(PointCount, 1);
  const std::vector<Point2> others = randomPoints(20, 2);
  const std::vector<IdSegment> segments = randomSegments(PointCount + others.size());
  const Tiling tiling = Tiling::balanced({ 0, 0, 1, 1 }, all, 23);
  const PartitionSegments near(tiling, segments, { PointsView(all), others }, 1);
  all.insert(all.end(), others.begin(), others.end());
  for (std::size_t p = 0; p < segments.size(); ++p)
  {
    const Point2 a = all[std::size_t(segments[p].A)];
    const Point2 b = all[std::size_t(segments[p].B)];
    constexpr int steps = 200;
    for (int i = 0; i <= steps; ++i)
    {
      const double t = double(i) / steps;
      const Point2 between{ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y) };
      ASSERT_TRUE(isNear(near, tiling.locate(i == steps ? b : between), std::int64_t(p)));
    }
  }
}

TEST(PartitionSegments, OfAPartitionAreNoneWithBothEndsInAnotherOne)
{
  const std::vector<Point2> all = randomPoints(PointCount, 3);
  const std::vector<IdSegment> segments = randomSegments(PointCount);
  const Tiling tiling = Tiling::balanced({ 0, 0, 1, 1 }, all, 4);
  const PartitionSegments near(tiling, segments, { PointsView(all), {} }, 1);
  int checked = 0;
  for (std::size_t p = 0; p < segments.size(); ++p)
  {
    const PartitionIndex first = tiling.locate(all[std::size_t(segments[p].A)]);
    for (PartitionIndex other = 0;
         first == tiling.locate(all[std::size_t(segments[p].B)]) && other < tiling.size(); ++other)
    {
      EXPECT_EQ(other == first, isNear(near, other, std::int64_t(p)));
      ++checked;
    }
  }
  EXPECT_LT(1000, checked);
}

TEST(PartitionSegments, DoNotDependOnTheNumberOfThreads)
{
  const std::vector<Point2> all = randomPoints(PointCount, 4);
  const std::vector<IdSegment> segments = randomSegments(PointCount);
  const Tiling tiling = Tiling::balanced({ 0, 0, 1, 1 }, all, 9);
  const PartitionSegments one(tiling, segments, { PointsView(all), {} }, 1);
  const PartitionSegments three(tiling, segments, { PointsView(all), {} }, 3);
  for (PartitionIndex p = 0; p < tiling.size(); ++p)
  {
    EXPECT_TRUE(std::equal(one.begin(p), one.end(p), three.begin(p), three.end(p)));
  }
}

} // namespace
