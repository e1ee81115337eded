// SPDX-License-Identifier: BSD-3-Clause
#include "Comparison.h"

#include <algorithm>
#include <atomic>

namespace
{

using namespace tipp;
using namespace tipp::test;

TriangulationOptions withPartitions()
{
  TriangulationOptions options;
  options.Columns = 8;
  options.Rows = 8;
  options.Threads = 2;
  return options;
}

TEST(Progress, RisesFromZeroToOneFromOneThreadAtATime)
{
  const Coordinates xy = makePointSet("uniform", 50000);
  std::atomic<int> inside{ 0 };
  std::vector<double> told;
  TriangulationOptions options = withPartitions();
  options.Progress = [&](double fraction)
  {
    EXPECT_EQ(1, ++inside);
    told.push_back(fraction);
    --inside;
    return true;
  };
  EXPECT_FALSE(triangulate(view(xy), options).Aborted);
  ASSERT_GT(told.size(), 3u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.front(), 0);
  EXPECT_LE(told.back(), 1);
  EXPECT_GT(told.back(), 0.5);
}

class Abort : public testing::TestWithParam<std::tuple<Schedule, int>>
{
};

TEST_P(Abort, EndsTheRunEarlyWithoutTriangles)
{
  const Coordinates xy = makePointSet("uniform", 50000);
  TriangulationOptions options = withPartitions();
  const auto [schedule, threads] = GetParam();
  options.Order = schedule;
  options.Threads = threads;
  int calls = 0;
  options.Progress = [&](double) { return ++calls < 4; };
  const Triangulation result = triangulate(view(xy), options);
  EXPECT_TRUE(result.Aborted);
  EXPECT_EQ(0u, result.triangleCount());
  EXPECT_LE(calls, 4) << "progress was reported after the abort";
}

std::string nameOf(const testing::TestParamInfo<Abort::ParamType>& info)
{
  const auto [schedule, threads] = info.param;
  return (schedule == Schedule::Stages ? "Stages" : "Dynamic") + std::to_string(threads);
}

INSTANTIATE_TEST_SUITE_P(Runs, Abort,
  testing::Combine(testing::Values(Schedule::Stages, Schedule::Dynamic), testing::Values(1, 2, 4)),
  nameOf);

TEST(AbortedRun, EndsEarlyWithOnePartition)
{
  const Coordinates xy = makePointSet("uniform", 200000);
  TriangulationOptions options;
  options.Columns = 1;
  options.Rows = 1;
  int calls = 0;
  options.Progress = [&](double) { return ++calls < 2; };
  const Triangulation result = triangulate(view(xy), options);
  EXPECT_TRUE(result.Aborted);
  EXPECT_EQ(0u, result.triangleCount());
  EXPECT_EQ(2, calls);
}

TEST(AbortedRun, StopsAtTheFirstCall)
{
  const Coordinates xy = makePointSet("uniform", 50000);
  TriangulationOptions options = withPartitions();
  options.Progress = [](double) { return false; };
  EXPECT_TRUE(triangulate(view(xy), options).Aborted);
}

TEST(AbortedRun, DoesNotAffectTheNextRun)
{
  const Coordinates xy = makePointSet("uniform", 5000);
  TriangulationOptions options = withPartitions();
  options.Progress = [](double) { return false; };
  triangulate(view(xy), options);
  options.Progress = nullptr;
  EXPECT_TRUE(matches(xy, triangulate(view(xy), options), reference(xy)));
}

} // namespace
