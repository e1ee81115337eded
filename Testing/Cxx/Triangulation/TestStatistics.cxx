// SPDX-License-Identifier: BSD-3-Clause
#include "Comparison.h"

#include <numeric>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

TriangulationStatistics statisticsOf(
  const std::string& set, std::size_t count, const TriangulationOptions& options)
{
  const Coordinates xy = makePointSet(set, count);
  return triangulate(view(xy), options).Statistics;
}

TEST(Statistics, CountTheGridsPartitionsAndTheThreads)
{
  TriangulationOptions options;
  options.Columns = 5;
  options.Rows = 3;
  options.Threads = 3;
  const TriangulationStatistics statistics = statisticsOf("uniform", 20000, options);
  EXPECT_EQ(15, statistics.Partitions);
  EXPECT_EQ(3, statistics.Threads);
}

TEST(Statistics, StagesActivateEachPartitionOnce)
{
  TriangulationOptions options;
  options.Columns = 8;
  options.Rows = 8;
  options.Order = Schedule::Stages;
  const TriangulationStatistics statistics = statisticsOf("uniform", 40000, options);
  std::int64_t active = 0;
  for (const auto& stage : statistics.Stages)
  {
    EXPECT_GT(stage.ActivePartitions, 0);
    EXPECT_GT(stage.MeshTriangles, 0);
    active += stage.ActivePartitions;
  }
  EXPECT_EQ(64, active);
  EXPECT_GT(statistics.Stages.size(), 1u);
  EXPECT_LT(statistics.Stages.size(), 64u) << "no two partitions were active together";
}

TEST(Statistics, WorkersTriangulateEveryPointAndFewTwice)
{
  TriangulationOptions options;
  options.Columns = 4;
  options.Rows = 4;
  const TriangulationStatistics statistics = statisticsOf("uniform", 100000, options);
  EXPECT_GE(statistics.WorkerVertices + statistics.InitialPoints, 100000);
  EXPECT_LE(statistics.WorkerVertices, 150000);
}

TEST(Statistics, ThereAreAsManyInitialPointsAsRequested)
{
  TriangulationOptions options;
  options.Columns = 4;
  options.Rows = 4;
  options.InitialPointsPerPartition = 10;
  const std::int64_t initial = statisticsOf("uniform", 40000, options).InitialPoints;
  EXPECT_GE(initial, 16 * 5);
  EXPECT_LE(initial, 16 * 10);
}

TEST(Statistics, OrdinaryPointsArePartitioned)
{
  for (const char* const set : { "uniform", "clustered", "kuzmin", "coast", "lattice" })
  {
    EXPECT_GT(statisticsOf(set, 200000, {}).Partitions, 1) << set;
  }
}

TEST(Statistics, PointsOnACurveAndMostPointsOnALineAreNotPartitioned)
{
  for (const char* const set : { "circle", "parabola", "collinear-and-one" })
  {
    EXPECT_EQ(statisticsOf(set, 200000, {}).Partitions, 1) << set;
  }
}

TEST(Statistics, PhasesHaveDistinctNamesAndTakeTime)
{
  const TriangulationStatistics statistics = statisticsOf("uniform", 100000, {});
  ASSERT_FALSE(statistics.Phases.empty());
  std::set<std::string> names;
  double total = 0;
  for (const auto& phase : statistics.Phases)
  {
    EXPECT_TRUE(names.insert(phase.Name).second) << phase.Name << " is there twice";
    EXPECT_GE(phase.Seconds, 0) << phase.Name;
    total += phase.Seconds;
  }
  EXPECT_GT(total, 0);
}

} // namespace
