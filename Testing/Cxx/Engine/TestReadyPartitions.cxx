// SPDX-License-Identifier: BSD-3-Clause
#include "DataflowScene.h"

#include "Engine/PartitionSchedule.h"

#include <atomic>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Partitions = std::vector<PartitionIndex>;

/// Two partitions that conflict.
PartitionOrder pairOrder()
{
  BoundaryTriangles mesh;
  const PartitionIndex both[] = { 0, 1 };
  mesh.add({ 0, 0, 0 }, both, both + 2);
  return PartitionOrder({ 1, 1 }, mesh);
}

class ReadyPartitionsWith : public testing::TestWithParam<bool>
{
protected:
  static ReadyPartitions::Waits waits()
  {
    return GetParam() ? ReadyPartitions::Waits::ForColour : ReadyPartitions::Waits::ForEarlier;
  }
};

TEST(ReadyPartitions, OwnPartitionsAreReadyOnceLoadedAndEarlierOnesAreDone)
{
  const PartitionOrder order = pairOrder();
  const PartitionIndex first = order.sequence()[0];
  const PartitionIndex second = order.sequence()[1];
  std::vector<char> isOwn(2, 0);
  isOwn[std::size_t(second)] = 1;
  ReadyPartitions ready(order, ReadyPartitions::Waits::ForEarlierAndLoad, isOwn);
  EXPECT_EQ(-1, ready.tryTake());
  ready.setLoaded(second);
  EXPECT_EQ(-1, ready.tryTake());
  ready.finish(first); // a partition of another rank
  EXPECT_EQ(second, ready.tryTake());
  EXPECT_EQ(-1, ready.take());
}

TEST(ReadyPartitions, TheLongestChainComesFirst)
{
  // 0, 1 and 2 conflict with each other, 3 with nothing.
  BoundaryTriangles mesh;
  const PartitionIndex met[] = { 0, 1, 2 };
  mesh.add({ 0, 0, 0 }, met, met + 3);
  const PartitionOrder order({ 1, 1, 1, 1 }, mesh);
  EXPECT_EQ((Partitions{ 0, 1, 3, 2 }), order.byUrgency());
  ReadyPartitions ready(order, ReadyPartitions::Waits::ForEarlier);
  EXPECT_EQ(0, ready.tryTake());
  ready.finish(0);
  EXPECT_EQ(1, ready.tryTake()); // before 3, which was ready earlier
  EXPECT_EQ(3, ready.tryTake());
  EXPECT_EQ(-1, ready.tryTake());
}

TEST(ReadyPartitions, LoadedPartitionsAreReadyIfOnlyLoadingCounts)
{
  const PartitionOrder order = pairOrder();
  ReadyPartitions ready(order, ReadyPartitions::Waits::ForLoad);
  EXPECT_EQ(-1, ready.tryTake());
  ready.setLoaded(order.sequence()[1]);
  EXPECT_EQ(order.sequence()[1], ready.take());
  ready.finish(order.sequence()[1]);
  EXPECT_EQ(-1, ready.tryTake());
}

TEST_P(ReadyPartitionsWith, EachPartitionIsHandedOutOnceAndAfterThoseBeforeIt)
{
  const DataflowScene scene("uniform", 3000, 9, 8);
  const PartitionOrder order = scene.order();
  ReadyPartitions ready(order, this->waits());
  std::vector<std::atomic<int>> finished(order.partitionCount());
  std::atomic<int> wrong{ 0 };
  const auto work = [&]
  {
    Partitions taken;
    for (PartitionIndex p = ready.take(); p >= 0; p = ready.take())
    {
      taken.push_back(p);
      for (const PartitionIndex q : order.sequence())
      {
        const bool mustBeDone = GetParam()
          ? order.colourOf(q) < order.colourOf(p)
          : order.position(q) < order.position(p) && conflict(order, p, q);
        wrong += mustBeDone && finished[std::size_t(q)] == 0;
      }
      finished[std::size_t(p)] = 1;
      ready.finish(p);
    }
    return taken;
  };
  std::vector<std::future<Partitions>> threads;
  for (int i = 0; i < 3; ++i)
  {
    threads.push_back(std::async(std::launch::async, work));
  }
  Partitions all;
  for (std::future<Partitions>& thread : threads)
  {
    const Partitions part = thread.get();
    all.insert(all.end(), part.begin(), part.end());
  }
  std::sort(all.begin(), all.end());
  Partitions expected = order.sequence();
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(expected, all);
  EXPECT_EQ(0, wrong);
}

TEST_P(ReadyPartitionsWith, FinishingHandsOutTheNextConflictingPartition)
{
  const PartitionOrder order = pairOrder();
  ReadyPartitions ready(order, this->waits());
  const PartitionIndex first = ready.take();
  EXPECT_EQ(order.sequence()[0], first);
  std::future<PartitionIndex> waiting =
    std::async(std::launch::async, [&ready] { return ready.take(); });
  ready.finish(first);
  EXPECT_EQ(order.sequence()[1], waiting.get());
  EXPECT_EQ(-1, ready.take());
}

TEST_P(ReadyPartitionsWith, StoppingEndsAWaitingThread)
{
  const PartitionOrder order = pairOrder();
  ReadyPartitions ready(order, this->waits());
  ASSERT_LE(0, ready.take());
  std::future<PartitionIndex> waiting =
    std::async(std::launch::async, [&ready] { return ready.take(); });
  ready.stop();
  EXPECT_EQ(-1, waiting.get());
  EXPECT_TRUE(ready.isStopped());
  EXPECT_FALSE(ready.failure());
}

TEST_P(ReadyPartitionsWith, TheFirstFailureIsKept)
{
  const PartitionOrder order = pairOrder();
  ReadyPartitions ready(order, this->waits());
  for (const char* text : { "first", "second" })
  {
    ready.stop(std::make_exception_ptr(std::runtime_error(text)));
  }
  ready.stop();
  ASSERT_TRUE(ready.failure());
  try
  {
    std::rethrow_exception(ready.failure());
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ("first", error.what());
  }
}

TEST_P(ReadyPartitionsWith, WithoutPartitionsThereIsNothingToDo)
{
  const PartitionOrder order({ 0, 0 }, BoundaryTriangles());
  EXPECT_EQ(-1, ReadyPartitions(order, this->waits()).take());
}

TEST_P(ReadyPartitionsWith, ATotalOrderIsHandedOutOneByOne)
{
  constexpr PartitionIndex count = 5000;
  Partitions all(count);
  for (PartitionIndex p = 0; p < count; ++p)
  {
    all[std::size_t(p)] = p;
  }
  BoundaryTriangles mesh;
  mesh.add({ 0, 0, 0 }, all.data(), all.data() + count);
  const PartitionOrder order(std::vector<char>(count, 1), mesh);
  ASSERT_TRUE(order.isTotal());
  ReadyPartitions ready(order, this->waits());
  Partitions taken;
  for (PartitionIndex p = ready.take(); p >= 0; p = ready.take())
  {
    taken.push_back(p);
    ready.finish(p);
  }
  EXPECT_EQ(order.sequence(), taken);
}

INSTANTIATE_TEST_SUITE_P(Barriers, ReadyPartitionsWith, testing::Bool(),
  [](const auto& info) { return info.param ? "BetweenColours" : "None"; });

} // namespace
