// SPDX-License-Identifier: BSD-3-Clause
#include "KernelTesting.h"

#include "Kernel/InsertionOrder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Order = std::vector<std::uint32_t>;

Order indices(InsertionOrder& computed, const std::vector<Point2>& points)
{
  computed.compute(points.data(), points.size());
  Order order(computed.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    order[k] = computed[k];
  }
  return order;
}

Order orderOf(const std::vector<Point2>& points)
{
  InsertionOrder computed;
  return indices(computed, points);
}

testing::AssertionResult isPermutation(Order order, std::size_t count)
{
  Order identity(count);
  std::iota(identity.begin(), identity.end(), 0U);
  std::sort(order.begin(), order.end());
  return order == identity
    ? testing::AssertionSuccess()
    : testing::AssertionFailure() << "not a permutation of " << count << " indices";
}

/// The length of the path through the points from index `begin` on, in this order.
double wayLength(const std::vector<Point2>& points, const Order& order, std::size_t begin)
{
  double sum = 0;
  for (std::size_t i = begin + 1; i < order.size(); ++i)
  {
    const Point2 p = points[order[i - 1]];
    const Point2 q = points[order[i]];
    sum += std::hypot(q.x - p.x, q.y - p.y);
  }
  return sum;
}

TEST(InsertionOrder, ContainsEveryPointOnce)
{
  for (const std::size_t count : { 2, 3, 255, 256, 257, 5000, 8191, 8192 })
  {
    EXPECT_TRUE(isPermutation(orderOf(pointSet("uniform", count)), count));
  }
}

TEST(InsertionOrder, IsTheSameForTheSamePoints)
{
  const std::vector<Point2> points = pointSet("clustered", 5000);
  InsertionOrder used;
  used.compute(pointSet("uniform", 700).data(), 700);
  EXPECT_EQ(orderOf(points), indices(used, points));
}

TEST(InsertionOrder, InstructionsDoNotChangeIt)
{
  for (const char* name : { "uniform", "clustered", "survey-lines" })
  {
    const std::vector<Point2> points = pointSet(name, 5003);
    InsertionOrder common(Instructions::Common);
    EXPECT_EQ(indices(common, points), orderOf(points)) << name;
  }
}

/// A point's round depends only on its position, and the last round is the largest.
TEST(InsertionOrder, AnEarlierRoundHoldsAboutOnePointInEight)
{
  const std::size_t count = 80000;
  const std::vector<Point2> points = pointSet("uniform", count);
  const Order order = orderOf(points);
  // Within a round, the steps along the curve are short. The first step of a round is long: it goes
  // from the curve's end to its start. So the last long step shows where the last round begins.
  std::size_t lastBegin = 0;
  for (std::size_t i = 1; i < count; ++i)
  {
    const Point2 p = points[order[i - 1]];
    const Point2 q = points[order[i]];
    lastBegin = std::hypot(q.x - p.x, q.y - p.y) > 0.5 ? i : lastBegin;
  }
  EXPECT_GT(lastBegin, count / 8 - count / 100);
  EXPECT_LT(lastBegin, count / 8 + count / 100);
}

TEST(InsertionOrder, NeighboursInARoundAreNearInThePlane)
{
  const std::size_t count = 20000;
  const std::vector<Point2> points = pointSet("uniform", count);
  Order random(count);
  std::iota(random.begin(), random.end(), 0U);
  EXPECT_LT(20 * wayLength(points, orderOf(points), 0), wayLength(points, random, 0));
}

/// The first rounds must be a random sample, so they must not follow the order of sorted input.
TEST(InsertionOrder, TheFirstPointsAreSpreadOverSortedInput)
{
  const std::size_t count = 20000;
  std::vector<Point2> points = pointSet("uniform", count);
  std::sort(
    points.begin(), points.end(), [](Point2 a, Point2 b) { return lexicographicLess(a, b); });
  const Order order = orderOf(points);
  std::size_t low = 0;
  for (std::size_t i = 0; i < count / 8; ++i)
  {
    low += order[i] < count / 2;
  }
  EXPECT_GT(low, count / 20);
  EXPECT_LT(low, count / 8 - count / 20);
}

/// Coarse levels of the curve are enough for evenly spread points; these need the finest levels.
TEST(InsertionOrder, NeighboursInATightClusterAreNearInThePlane)
{
  const std::size_t count = 3000;
  std::vector<Point2> points = pointSet("uniform", count);
  for (Point2& p : points)
  {
    p = { p.x / 256, p.y / 256 };
  }
  Order given(count);
  std::iota(given.begin(), given.end(), 0U);
  const double unordered = wayLength(points, given, 0);
  points.push_back({ 1, 1 });
  Order order = orderOf(points);
  order.erase(std::find(order.begin(), order.end(), std::uint32_t(count)));
  EXPECT_LT(10 * wayLength(points, order, 0), unordered);
}

/// Clusters around the origin, each a millionth of the size of the one before. No fixed number of
/// levels separates the points of the smallest clusters.
TEST(InsertionOrder, NeighboursInEveryOfManyNestedClustersAreNear)
{
  const std::size_t count = 3000;
  const std::vector<Point2> cluster = pointSet("uniform", count);
  const int clusters = 12;
  std::vector<Point2> points;
  for (int i = 0; i < clusters; ++i)
  {
    for (const Point2 p : cluster)
    {
      points.push_back({ std::ldexp(p.x, -20 * i), std::ldexp(p.y, -20 * i) });
    }
  }
  const Order order = orderOf(points);
  ASSERT_TRUE(isPermutation(order, points.size()));
  Order given(count);
  std::iota(given.begin(), given.end(), 0U);
  for (int i = 0; i < clusters; ++i)
  {
    Order mine;
    for (const std::uint32_t index : order)
    {
      if (index / count == std::size_t(i))
      {
        mine.push_back(std::uint32_t(index % count));
      }
    }
    EXPECT_LT(10 * wayLength(cluster, mine, 0), wayLength(cluster, given, 0)) << "cluster " << i;
  }
}

TEST(InsertionOrder, ContainsAllCopiesOfAPoint)
{
  EXPECT_TRUE(isPermutation(orderOf(std::vector<Point2>(1000, { 3, -4 })), 1000));
}

TEST(InsertionOrder, ContainsAllPointsOnAnAxis)
{
  std::vector<Point2> points;
  for (int i = 0; i < 1000; ++i)
  {
    points.push_back({ 0, double(i % 400) });
  }
  EXPECT_TRUE(isPermutation(orderOf(points), 1000));
}

TEST(InsertionOrder, AcceptsAnExtentBeyondDoubles)
{
  std::vector<Point2> points;
  for (int i = 0; i < 300; ++i)
  {
    points.push_back({ i % 2 ? 1.7e308 : -1.7e308, double(i) });
  }
  EXPECT_TRUE(isPermutation(orderOf(points), 300));
}

TEST(InsertionOrder, AcceptsTheSmallestExtent)
{
  std::vector<Point2> points;
  for (int i = 0; i < 300; ++i)
  {
    points.push_back({ i % 2 * 4.9406564584124654e-324, 0 });
  }
  EXPECT_TRUE(isPermutation(orderOf(points), 300));
}

TEST(InsertionOrder, OnePointIsTheFirst)
{
  EXPECT_EQ(Order{ 0 }, orderOf({ { 7, 8 } }));
}

TEST(InsertionOrder, NoPointsHaveAnEmptyOrder)
{
  InsertionOrder order;
  order.compute(pointSet("uniform", 10).data(), 10);
  order.compute(nullptr, 0);
  EXPECT_EQ(0U, order.size());
}

} // namespace
