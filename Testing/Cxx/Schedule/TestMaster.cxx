// SPDX-License-Identifier: BSD-3-Clause
#include "InitialScene.h"

#include "Triangulation/Master.h"

#include <algorithm>
#include <future>
#include <stdexcept>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Partitions = std::vector<PartitionIndex>;

class MasterOf : public testing::TestWithParam<Schedule>
{
};

/// Takes partitions until there are none, and brings nothing back.
Partitions takeAll(Master& master)
{
  Partitions taken;
  std::vector<SeamTriangle> belonging;
  for (PartitionIndex p = master.acquire(belonging); p >= 0; p = master.acquire(belonging))
  {
    taken.push_back(p);
    master.complete(p, {}, {}, 0);
  }
  return taken;
}

TEST_P(MasterOf, EveryPartitionIsHandedOutOnce)
{
  const InitialScene scene("uniform", 2000, 6, 6);
  Master master(GetParam(), 36, scene.partitionsWithPoints(), scene.Mesh);
  Partitions taken = takeAll(master);
  std::sort(taken.begin(), taken.end());
  EXPECT_EQ(scene.partitionsWithPoints(), taken);
}

TEST_P(MasterOf, IndependentPartitionsAreHandedOutTogether)
{
  Master master(GetParam(), 3, { 0, 1, 2 },
    seamTriangles({ { seamTriangle(1, 0, 0, 1), { 0 } }, { seamTriangle(4, 4, 4, 5), { 1 } } }));
  std::vector<SeamTriangle> belonging;
  Partitions taken;
  for (int i = 0; i < 3; ++i)
  {
    taken.push_back(master.acquire(belonging));
  }
  std::sort(taken.begin(), taken.end());
  EXPECT_EQ((Partitions{ 0, 1, 2 }), taken);
}

TEST_P(MasterOf, ThreeThreadsShareThePartitions)
{
  const InitialScene scene("uniform", 3000, 8, 8);
  Master master(GetParam(), 64, scene.partitionsWithPoints(), scene.Mesh);
  std::vector<std::future<Partitions>> threads;
  for (int i = 0; i < 3; ++i)
  {
    threads.push_back(std::async(std::launch::async, [&master] { return takeAll(master); }));
  }
  Partitions taken;
  for (std::future<Partitions>& thread : threads)
  {
    const Partitions part = thread.get();
    taken.insert(taken.end(), part.begin(), part.end());
  }
  std::sort(taken.begin(), taken.end());
  EXPECT_EQ(scene.partitionsWithPoints(), taken);
}

TEST_P(MasterOf, APartitionComesWithTheTrianglesThatBelongToIt)
{
  const InitialScene scene("uniform", 2000, 4, 4);
  Master master(GetParam(), 16, scene.partitionsWithPoints(), scene.Mesh);
  std::vector<SeamTriangle> belonging;
  const PartitionIndex p = master.acquire(belonging);
  std::vector<SeamTriangle> expected;
  for (std::size_t i = 0; i < scene.Mesh.size(); ++i)
  {
    if (std::count(scene.Mesh.metBegin(i), scene.Mesh.metEnd(i), p) > 0)
    {
      expected.push_back(scene.Mesh[i]);
    }
  }
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(idsOf(expected), idsOf(belonging));
}

TEST_P(MasterOf, AStoppedMasterHandsOutNothing)
{
  const InitialScene scene("uniform", 500, 3, 3);
  Master master(GetParam(), 9, scene.partitionsWithPoints(), scene.Mesh);
  master.stop();
  std::vector<SeamTriangle> belonging;
  EXPECT_EQ(-1, master.acquire(belonging));
  EXPECT_TRUE(master.isStopped());
  EXPECT_FALSE(master.failure());
}

/// The thread that waits for the one active partition must not wait for ever.
TEST_P(MasterOf, StoppingEndsAWaitingThread)
{
  SeamTriangles mesh = seamTriangles({ { seamTriangle(1, 0, 0, 4), { 0, 1 } } });
  Master master(GetParam(), 2, { 0, 1 }, mesh);
  std::vector<SeamTriangle> belonging;
  ASSERT_LE(0, master.acquire(belonging));
  std::future<PartitionIndex> waiting = std::async(std::launch::async,
    [&master]
    {
      std::vector<SeamTriangle> others;
      return master.acquire(others);
    });
  master.stop();
  EXPECT_EQ(-1, waiting.get());
}

TEST_P(MasterOf, CompletingWakesAThreadThatWaitsForAConflictingPartition)
{
  SeamTriangles mesh = seamTriangles({ { seamTriangle(1, 0, 0, 4), { 0, 1 } } });
  Master master(GetParam(), 2, { 0, 1 }, mesh);
  std::vector<SeamTriangle> belonging;
  const PartitionIndex first = master.acquire(belonging);
  std::future<PartitionIndex> waiting = std::async(std::launch::async,
    [&master]
    {
      std::vector<SeamTriangle> others;
      return master.acquire(others);
    });
  master.complete(first, {}, {}, 0);
  EXPECT_EQ(1 - first, waiting.get());
}

TEST_P(MasterOf, TheFirstFailureIsKept)
{
  Master master(GetParam(), 1, { 0 }, {});
  const auto stop = [&master](const char* text)
  { master.stop(std::make_exception_ptr(std::runtime_error(text))); };
  stop("first");
  stop("second");
  master.stop();
  ASSERT_TRUE(master.failure());
  try
  {
    std::rethrow_exception(master.failure());
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ("first", error.what());
  }
}

TEST_P(MasterOf, PartitionsWithoutPointsAreFinishedFromTheStart)
{
  const SeamTriangle a = seamTriangle(10, 0, 0, 1);
  const SeamTriangle b = seamTriangle(20, 4, 4, 5);
  Master master(GetParam(), 3, { 1 }, seamTriangles({ { a, { 0, 2 } }, { b, { 0, 1 } } }));
  EXPECT_EQ(idsOf(finalSeams({ a })), idsOf(master.Final));
  EXPECT_EQ(Partitions{ 1 }, takeAll(master));
}

TEST_P(MasterOf, WithoutPartitionsThereIsNothingToDo)
{
  Master master(GetParam(), 2, {}, seamTriangles({ { seamTriangle(1, 0, 0, 4), { 0, 1 } } }));
  EXPECT_TRUE(takeAll(master).empty());
  EXPECT_EQ(1U, master.Final.triangles().size());
}

TEST_P(MasterOf, WhatWorkersBringIsFinalOrGoesToTheNextOnes)
{
  const SeamTriangle old = seamTriangle(10, 0, 0, 4);
  const SeamTriangle seam = seamTriangle(20, 0, 4, 4);
  const SeamTriangle done = seamTriangle(30, 0, 0, 0);
  Master master(GetParam(), 2, { 0, 1 }, seamTriangles({ { old, { 0, 1 } } }));
  std::vector<SeamTriangle> belonging;
  const PartitionIndex first = master.acquire(belonging);
  EXPECT_EQ(idsOf(std::vector<SeamTriangle>{ old }), idsOf(belonging));
  master.complete(
    first, seamTriangles({ { seam, { 0, 1 } }, { done, { first } } }), { { 5, 3 } }, 100);
  EXPECT_EQ(idsOf(finalSeams({ done })), idsOf(master.Final));
  const PartitionIndex second = master.acquire(belonging);
  EXPECT_EQ(idsOf(std::vector<SeamTriangle>{ seam }), idsOf(belonging));
  master.complete(second, seamTriangles({ { seam, { 0, 1 } } }), { { 9, 8 } }, 11);
  EXPECT_EQ(idsOf(finalSeams({ done, seam })), idsOf(master.Final));
  EXPECT_EQ(2U, master.Duplicates.size());
  EXPECT_EQ(111U, master.WorkerVertices);
}

INSTANTIATE_TEST_SUITE_P(Schedules, MasterOf, testing::Values(Schedule::Stages, Schedule::Dynamic),
  [](const auto& info) { return info.param == Schedule::Stages ? "Stages" : "Dynamic"; });

TEST(MasterInStages, AStageBeginsWhenTheOneBeforeIsThrough)
{
  // Partition 0 is independent of 2, and 1 of neither.
  const SeamTriangles mesh = seamTriangles(
    { { seamTriangle(1, 0, 0, 4), { 0, 1 } }, { seamTriangle(4, 5, 8, 8), { 1, 2 } } });
  Master master(Schedule::Stages, 3, { 0, 1, 2 }, mesh);
  EXPECT_EQ(3U, takeAll(master).size());
  ASSERT_EQ(2U, master.Stages.size());
  EXPECT_EQ(2, master.Stages[0].ActivePartitions);
  EXPECT_EQ(2, master.Stages[0].MeshTriangles);
  EXPECT_EQ(1, master.Stages[1].ActivePartitions);
  EXPECT_EQ(0, master.Stages[1].MeshTriangles);
}

} // namespace
