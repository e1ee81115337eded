// SPDX-License-Identifier: BSD-3-Clause
#include "ScheduleTesting.h"

#include <algorithm>
#include <cmath>

namespace
{

using namespace tipp;
using namespace tipp::test;

template <typename Id>
class BucketsOf : public testing::Test
{
};

TYPED_TEST_SUITE(BucketsOf, IdTypes, IdNames);

/// Points of the unit square, some of which are not finite. Their number is no multiple of a batch.
Coordinates pointsWithHoles()
{
  Coordinates xy = makePointSet("uniform", 5003);
  for (std::size_t i = 0; i < 5003; i += 97)
  {
    xy[2 * i + i % 2] = i % 3 == 0 ? std::nan("") : (i % 3 == 1 ? HUGE_VAL : -HUGE_VAL);
  }
  return xy;
}

Tiling someTiling()
{
  return Tiling::grid({ 0, 0, 1, 1 }, 5, 3);
}

template <typename Id>
std::vector<Id> bucketIds(const PointBuckets<Id>& buckets, PartitionIndex p)
{
  std::vector<Id> ids;
  buckets.copyIds(p, ids);
  return ids;
}

TYPED_TEST(BucketsOf, EveryFinitePointIsInItsPartitionsBucketInTheInputsOrder)
{
  const Coordinates xy = pointsWithHoles();
  const std::vector<Point2> points = asPoints(xy);
  const Tiling tiling = someTiling();
  auto buckets = bucketPoints<TypeParam>(view(xy), tiling, 1);
  ASSERT_EQ(tiling.size(), buckets.partitions());
  std::vector<std::vector<TypeParam>> expected(std::size_t(tiling.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (std::isfinite(points[i].x) && std::isfinite(points[i].y))
    {
      expected[std::size_t(tiling.locate(points[i]))].push_back(TypeParam(i));
    }
  }
  for (PartitionIndex p = 0; p < tiling.size(); ++p)
  {
    const std::vector<TypeParam> ids = bucketIds(buckets, p);
    ASSERT_EQ(expected[std::size_t(p)], ids);
    for (std::size_t i = 0; i < buckets.count(p); ++i)
    {
      ASSERT_EQ(points[std::size_t(ids[i])], buckets.points(p)[i]);
    }
  }
}

TYPED_TEST(BucketsOf, AreTheSameForAnyNumberOfThreads)
{
  const Coordinates xy = pointsWithHoles();
  const Tiling tiling = someTiling();
  auto one = bucketPoints<TypeParam>(view(xy), tiling, 1);
  for (const int threads : { 2, 3, 7 })
  {
    auto more = bucketPoints<TypeParam>(view(xy), tiling, threads);
    for (PartitionIndex p = 0; p < tiling.size(); ++p)
    {
      ASSERT_EQ(one.count(p), more.count(p));
      ASSERT_EQ(bucketIds(one, p), bucketIds(more, p));
      ASSERT_TRUE(std::equal(one.points(p), one.points(p) + one.count(p), more.points(p)));
    }
  }
}

TYPED_TEST(BucketsOf, MoreThreadsThanPointsAreFine)
{
  const Coordinates xy{ 0.1, 0.1, 0.9, 0.9 };
  auto buckets = bucketPoints<TypeParam>(view(xy), someTiling(), 7);
  EXPECT_EQ(2U, buckets.size());
  EXPECT_EQ(0, buckets.id(someTiling().locate({ 0.1, 0.1 }), 0));
  EXPECT_EQ(1, buckets.id(someTiling().locate({ 0.9, 0.9 }), 0));
}

TYPED_TEST(BucketsOf, RejectedPointsAreInNoBucket)
{
  const Coordinates xy(200, std::nan(""));
  const auto buckets = bucketPoints<TypeParam>(view(xy), someTiling(), 2);
  EXPECT_EQ(0U, buckets.size());
}

TYPED_TEST(BucketsOf, PointsInForeignMemoryAreKeptAndTheirIndicesAreTheirIds)
{
  const std::vector<Point2> points{ { 1, 2 }, { 3, 4 }, { 5, 6 }, { 7, 8 } };
  PointBuckets<TypeParam> buckets({ 0, 1, 1, 4 }, points.data(), 1);
  for (PartitionIndex p = 0; p < buckets.partitions(); ++p)
  {
    std::fill_n(buckets.triangles(p), 6 * buckets.count(p), TypeParam(9));
  }
  EXPECT_EQ((std::vector<TypeParam>{ 0 }), bucketIds(buckets, 0));
  EXPECT_EQ((std::vector<TypeParam>{}), bucketIds(buckets, 1));
  EXPECT_EQ((std::vector<TypeParam>{ 1, 2, 3 }), bucketIds(buckets, 2));
  EXPECT_EQ((Point2{ 3, 4 }), buckets.points(2)[0]);
  EXPECT_EQ(2, buckets.id(2, 1));
  EXPECT_EQ(3U * (2 * 4 + 1), buckets.release().size());
}

TYPED_TEST(BucketsOf, ThereIsSpaceForTwoTrianglesPerPoint)
{
  const Coordinates xy = makePointSet("uniform", 1000);
  auto buckets = bucketPoints<TypeParam>(view(xy), someTiling(), 1);
  for (PartitionIndex p = 0; p + 1 < buckets.partitions(); ++p)
  {
    EXPECT_EQ(buckets.triangles(p) + 6 * buckets.count(p), buckets.triangles(p + 1));
  }
  EXPECT_EQ(6000U, buckets.release().size());
}

TEST(PointSurvey, ListsPointsThatAreNotFiniteInAscendingOrder)
{
  const Coordinates xy = pointsWithHoles();
  std::vector<std::int64_t> expected;
  for (std::int64_t i = 0; i < 5003; i += 97)
  {
    expected.push_back(i);
  }
  for (const int threads : { 1, 2, 3 })
  {
    EXPECT_EQ(expected, surveyPoints(view(xy), threads).Rejected);
  }
}

TEST(PointSurvey, BoundsAreThoseOfTheFinitePoints)
{
  const Coordinates xy{ 3, 4, -1, 9, HUGE_VAL, -100, 2, std::nan(""), 0, 5 };
  for (const int threads : { 1, 2, 8 })
  {
    const Box2 bounds = surveyPoints(view(xy), threads).Bounds;
    EXPECT_EQ(-1, bounds.Min.x);
    EXPECT_EQ(4, bounds.Min.y);
    EXPECT_EQ(3, bounds.Max.x);
    EXPECT_EQ(9, bounds.Max.y);
  }
}

TEST(PointSample, IsSpreadEvenlyOverTheInput)
{
  Coordinates xy;
  for (int i = 0; i < 1000; ++i)
  {
    xy.insert(xy.end(), { double(i), 0 });
  }
  const std::vector<Point2> sample = samplePoints(view(xy), 10);
  ASSERT_EQ(10U, sample.size());
  for (std::size_t i = 0; i < 10; ++i)
  {
    EXPECT_EQ(100 * double(i) + 50, sample[i].x);
  }
}

TEST(PointSample, IsAllPointsOfASmallInput)
{
  const Coordinates xy = makePointSet("uniform", 20);
  EXPECT_EQ(20U, samplePoints(view(xy), 100).size());
}

TEST(PointSample, LeavesOutPointsThatAreNotFinite)
{
  Coordinates xy = makePointSet("uniform", 20);
  xy[6] = std::nan("");
  xy[9] = HUGE_VAL;
  EXPECT_EQ(18U, samplePoints(view(xy), 20).size());
}

} // namespace
