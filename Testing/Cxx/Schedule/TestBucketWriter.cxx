// SPDX-License-Identifier: BSD-3-Clause
#include "ScheduleTesting.h"

#include "Triangulation/PointBuckets.h"

#include <algorithm>
#include <random>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

template <typename Id>
class BucketWriterTest : public testing::Test
{
public:
  /// Writes buckets of these sizes, in random order. The first begins at index `firstPlace`; after
  /// each bucket one item stays unwritten.
  void distribute(const std::vector<std::size_t>& sizes, std::size_t firstPlace, unsigned seed)
  {
    std::vector<std::size_t> starts;
    std::vector<std::size_t> order;
    std::size_t end = firstPlace;
    for (std::size_t b = 0; b < sizes.size(); ++b)
    {
      starts.push_back(end);
      end += sizes[b] + 1;
      order.insert(order.end(), sizes[b], b);
    }
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    this->Points.assign(end, Unwritten);
    this->Ids.assign(end, -1);
    std::vector<Point2> points(end, Unwritten);
    std::vector<Id> ids(end, -1);
    std::vector<typename BucketWriter<Id>::Bucket> buckets;
    for (const std::size_t start : starts)
    {
      buckets.push_back({ points.data(), ids.data(), start });
    }
    BucketWriter<Id> writer(std::move(buckets));
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const Point2 p{ double(i), -double(i) };
      writer.append(order[i], p, Id(i));
      this->Points[starts[order[i]]] = p;
      this->Ids[starts[order[i]]++] = Id(i);
    }
    writer.finish();
    EXPECT_TRUE(this->Points == points);
    EXPECT_EQ(this->Ids, ids);
  }

  static constexpr Point2 Unwritten{ 0.25, 0.25 };
  std::vector<Point2> Points;
  std::vector<Id> Ids;
};

TYPED_TEST_SUITE(BucketWriterTest, IdTypes, IdNames);

TYPED_TEST(BucketWriterTest, WritesEachBucketInOrderAndNothingElse)
{
  this->distribute({ 100, 1, 0, 64, 63, 65, 1000, 7 }, 0, 1);
}

TYPED_TEST(BucketWriterTest, BucketsMayBeginAnywhereInACacheLine)
{
  for (std::size_t first = 1; first < 17; ++first)
  {
    this->distribute({ 3, 40, 5, 33, 16, 17 }, first, unsigned(first));
  }
}

TYPED_TEST(BucketWriterTest, WithoutItemsNothingIsWritten)
{
  this->distribute({ 0, 0, 0 }, 5, 1);
}

} // namespace
