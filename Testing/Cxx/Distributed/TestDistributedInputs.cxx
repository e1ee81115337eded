// SPDX-License-Identifier: BSD-3-Clause
// Any distribution of points over the ranks.
#include "DistributedTesting.h"

#include "Distributed/DistributedTriangulation.h"

#include "vtkMultiProcessController.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <set>
#include <thread>

namespace
{

using namespace tipp;
using namespace tipp::test;

DistributedOptions manyPartitions(Masters design)
{
  DistributedOptions options;
  options.Design = design;
  options.Threshold = 80;
  options.Threads = 1;
  return options;
}

void expectReference(const std::string& set, std::size_t count, Share share)
{
  const Coordinates xy = makePointSet(set, count);
  for (const Masters design : { Masters::Auto, Masters::Single, Masters::Multi })
  {
    const Gathered result = triangulateShares(xy, share, manyPartitions(design));
    if (rank() == 0)
    {
      Reference expected = reference(xy);
      if (share == Share::Copies)
      {
        // Duplicates are not compared: here they have the same global id as their representative.
        EXPECT_TRUE(result.Mesh == expected.Mesh);
        continue;
      }
      EXPECT_TRUE(matches(xy, result, expected)) << nameOf(share);
    }
  }
}

TEST(DistributedInputs, AllPointsOnOneRank)
{
  expectReference("uniform", 3000, Share::AllOnLast);
}

TEST(DistributedInputs, UnevenShares)
{
  expectReference("clustered", 3000, Share::Uneven);
}

TEST(DistributedInputs, ConsecutiveBlocks)
{
  expectReference("coast", 3000, Share::Blocks);
}

TEST(DistributedInputs, DuplicatesOverRanks)
{
  expectReference("duplicate-lattice", 3000, Share::RoundRobin);
}

TEST(DistributedInputs, EveryRankHasAllPoints)
{
  expectReference("uniform", 1000, Share::Copies);
}

TEST(DistributedInputs, FewerPointsThanRanks)
{
  expectReference("uniform", 3, Share::RoundRobin);
  expectReference("uniform", 2, Share::RoundRobin);
}

TEST(DistributedInputs, NoPointsAtAll)
{
  const Gathered result = triangulateShares({}, Share::RoundRobin, {});
  EXPECT_TRUE(result.Mesh.empty());
}

TEST(DistributedInputs, CollinearPointsGiveDuplicatesOnly)
{
  Coordinates xy;
  for (int i = 0; i < 40; ++i)
  {
    xy.insert(xy.end(), { double(i % 20), 2.0 * (i % 20) });
  }
  const Gathered result = triangulateShares(xy, Share::RoundRobin, {});
  if (rank() == 0)
  {
    EXPECT_TRUE(result.Mesh.empty());
    ASSERT_EQ(result.Duplicates.size(), 20u);
    EXPECT_EQ(result.Duplicates[0].Point, 20);
    EXPECT_EQ(result.Duplicates[0].Representative, 0);
  }
}

TEST(DistributedInputs, HugeAndTinyCoordinates)
{
  expectReference("huge-1e300", 1500, Share::RoundRobin);
  expectReference("tiny-1e-300", 1500, Share::RoundRobin);
}

TEST(DistributedInputs, PartitionsThatDoNotPay)
{
  expectReference("circle", 6000, Share::RoundRobin);
}

TEST(DistributedInputs, RowsTravelWithTheirPoints)
{
  const Coordinates xy = makePointSet("uniform", 2000);
  Communicator box(vtkMultiProcessController::GetGlobalController());
  const RankShare mine = shareOf(xy, Share::RoundRobin, box.rank(), box.size());
  RankPoints points;
  points.Points = PointsView(mine.XY.data(), mine.GlobalIds.size(), 2);
  points.GlobalIds = mine.GlobalIds.data();
  points.RowSize = sizeof(PointId) + 1;
  points.PackRow = [&](std::size_t i, char* to)
  {
    const PointId value = 7 * mine.GlobalIds[i];
    std::memcpy(to, &value, sizeof(value));
    to[sizeof(value)] = 'x';
  };
  const auto result = triangulateDistributed(box, points, manyPartitions(Masters::Single));
  for (const PointTuples* tuples : { &result.Owned, &result.Ghosts })
  {
    for (std::size_t i = 0; i < tuples->size(); ++i)
    {
      PointId value = 0;
      const char* row = tuples->Rows.data() + i * points.RowSize;
      std::memcpy(&value, row, sizeof(value));
      ASSERT_EQ(value, 7 * tuples->GlobalIds[i]);
      ASSERT_EQ(row[sizeof(value)], 'x');
    }
  }
}

TEST(DistributedInputs, GlobalIdsAreCountedOverRanksWhenNoneAreGiven)
{
  Communicator box(vtkMultiProcessController::GetGlobalController());
  const Coordinates xy = makePointSet("uniform", 500, std::uint64_t(box.rank()) + 1);
  RankPoints points;
  points.Points = PointsView(xy.data(), xy.size() / 2, 2);
  const auto result = triangulateDistributed(box, points, {});
  std::vector<std::int64_t> seen(500 * std::size_t(box.size()), 0);
  for (const PointId id : result.Owned.GlobalIds)
  {
    ++seen.at(std::size_t(id));
  }
  box.sum(seen);
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ptrdiff_t(seen.size()));
}

TEST(GhostTriangles, AreOtherRanksTrianglesAtOwnVerticesEachOnce)
{
  const Coordinates xy = makePointSet("uniform", 3000);
  Communicator box(vtkMultiProcessController::GetGlobalController());
  const RankShare mine = shareOf(xy, Share::RoundRobin, box.rank(), box.size());
  RankPoints points;
  points.Points = PointsView(mine.XY.data(), mine.GlobalIds.size(), 2);
  points.GlobalIds = mine.GlobalIds.data();
  const auto result = triangulateDistributed(box, points, manyPartitions(Masters::Single));
  const GhostTriangles ghosts = fetchGhosts(box, result);
  const std::vector<IdTriangle> own = trianglesByIds(result, box.rank());

  // For comparison, gathers the triangles of all ranks on every rank, and selects the ghosts by
  // their definition.
  std::vector<IdTriangle> every;
  for (const std::vector<IdTriangle>& part : box.allGather(own))
  {
    every.insert(every.end(), part.begin(), part.end());
  }
  std::set<std::int64_t> vertices;
  for (const IdTriangle& t : own)
  {
    vertices.insert(t.begin(), t.end());
  }
  std::set<std::int64_t> expected;
  for (std::size_t i = 0; i < every.size(); ++i)
  {
    const bool isOwn = std::int64_t(i) >= result.FirstCell &&
      std::int64_t(i) < result.FirstCell + std::int64_t(own.size());
    const bool touches = std::any_of(
      every[i].begin(), every[i].end(), [&](std::int64_t id) { return vertices.count(id) > 0; });
    if (!isOwn && touches)
    {
      expected.insert(std::int64_t(i));
    }
  }
  EXPECT_EQ(expected.size(), ghosts.Numbers.size());
  EXPECT_EQ(expected, std::set<std::int64_t>(ghosts.Numbers.begin(), ghosts.Numbers.end()));
  EXPECT_EQ(expected.empty(), box.size() == 1);
}

class DistributedDesign : public testing::TestWithParam<Masters>
{
};

TEST_P(DistributedDesign, StoppingOneRankStopsAll)
{
  const Coordinates xy = makePointSet("uniform", 20000);
  Communicator box(vtkMultiProcessController::GetGlobalController());
  const RankShare mine = shareOf(xy, Share::RoundRobin, box.rank(), box.size());
  RankPoints points;
  points.Points = PointsView(mine.XY.data(), mine.GlobalIds.size(), 2);
  DistributedOptions options = manyPartitions(GetParam());
  options.Progress = [&](double) { return box.rank() != box.size() - 1; };
  try
  {
    triangulateDistributed(box, points, options);
    FAIL() << "nothing was thrown";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_TRUE(failure.Aborted);
  }
}

TEST_P(DistributedDesign, AFailureOnOneRankFailsAll)
{
  const Coordinates xy = makePointSet("uniform", 20000);
  const auto run = [&](bool fails)
  {
    Communicator box(vtkMultiProcessController::GetGlobalController());
    const RankShare mine = shareOf(xy, Share::RoundRobin, box.rank(), box.size());
    RankPoints points;
    points.Points = PointsView(mine.XY.data(), mine.GlobalIds.size(), 2);
    DistributedOptions options = manyPartitions(GetParam());
    options.Progress = [&](double) -> bool
    {
      if (fails && box.rank() == box.size() - 1)
      {
        throw std::runtime_error("the disk is on fire");
      }
      return true;
    };
    return triangulateDistributed(box, points, options).AllCells;
  };
  try
  {
    run(true);
    FAIL() << "nothing was thrown";
  }
  catch (const RankFailure& failure)
  {
    EXPECT_STREQ(failure.what(), "the disk is on fire");
    EXPECT_EQ(failure.Rank, ranks() - 1);
  }
  // The failure must not affect the next run.
  EXPECT_GT(run(false), 0);
}

INSTANTIATE_TEST_SUITE_P(Masters, DistributedDesign,
  testing::Values(Masters::Auto, Masters::Single, Masters::Multi),
  [](const auto& info)
  {
    return info.param == Masters::Auto ? "None" : info.param == Masters::Single ? "One" : "Several";
  });

/// The main thread sends and receives messages at random times.
TEST(DistributedInputs, DelayedMessagesChangeNothing)
{
  const Coordinates xy = makePointSet("clustered", 4000);
  const Reference expected = reference(xy);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    std::mt19937_64 random(seed + 100 * std::uint64_t(rank()));
    DistributedOptions options = manyPartitions(Masters::Auto);
    options.Threads = 2;
    options.Progress = [&](double)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
      return true;
    };
    const Gathered result = triangulateShares(xy, Share::RoundRobin, options);
    if (rank() == 0)
    {
      EXPECT_TRUE(matches(xy, result, expected)) << "seed " << seed;
    }
  }
}

} // namespace
