// SPDX-License-Identifier: BSD-3-Clause
// How the domain is divided, and how its leaves are assigned to ranks.
#include "../Schedule/ScheduleTesting.h"

#include "Distributed/Plan.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace
{

using namespace tipp;
using namespace tipp::test;

PlanInput inputOf(const Coordinates& xy, int ranks)
{
  PlanInput input;
  input.Domain = boundsOf(xy);
  input.Points = std::int64_t(xy.size() / 2);
  input.Sample = asPoints(xy);
  input.Ranks = ranks;
  input.Threads = ranks;
  return input;
}

std::vector<std::int64_t> leafCounts(const Plan& plan, const Coordinates& xy)
{
  std::vector<std::int64_t> counts(std::size_t(plan.Leaves.size()), 0);
  for (const Point2 p : asPoints(xy))
  {
    ++counts[std::size_t(plan.Leaves.locate(p))];
  }
  return counts;
}

DistributedOptions multiMaster(GridSize major, GridSize minor)
{
  DistributedOptions options;
  options.Design = Masters::Multi;
  options.Major = major;
  options.Minor = minor;
  options.MinorDivision = Division::Grid;
  return options;
}

std::vector<std::int64_t> pointsOfRanks(
  const Plan& plan, const std::vector<std::int64_t>& counts, int ranks)
{
  std::vector<std::int64_t> points(std::size_t(ranks), 0);
  for (std::size_t leaf = 0; leaf < counts.size(); ++leaf)
  {
    points[std::size_t(plan.Owners[leaf])] += counts[leaf];
  }
  return points;
}

TEST(Plan, FewPointsGoToOneRank)
{
  const Plan plan = divide(inputOf(makePointSet("uniform", 1000), 4), {});
  EXPECT_TRUE(plan.isAlone());
  EXPECT_EQ(plan.Owners, std::vector<std::int32_t>{ 0 });
}

TEST(Plan, ThePartitionsOfOneMasterAreTheLeaves)
{
  DistributedOptions options;
  options.Design = Masters::Single;
  options.Minor = { 8, 4 };
  options.MinorDivision = Division::Grid;
  const Plan plan = divide(inputOf(makePointSet("uniform", 20000), 3), options);
  ASSERT_EQ(plan.Areas.size(), 1u);
  EXPECT_EQ(plan.Areas[0].Boxes.size(), 32);
  EXPECT_EQ(plan.Leaves.size(), 32);
}

TEST(Plan, SeveralMastersHaveTheMinorPartitionsOfTheirMajorPartition)
{
  const Plan plan =
    divide(inputOf(makePointSet("uniform", 20000), 4), multiMaster({ 2, 2 }, { 3, 3 }));
  ASSERT_EQ(plan.Areas.size(), 5u);
  EXPECT_EQ(plan.majors(), 4);
  EXPECT_EQ(plan.Leaves.size(), 36);
  PartitionIndex first = 0;
  for (std::size_t a = 1; a < plan.Areas.size(); ++a)
  {
    EXPECT_EQ(plan.Areas[a].Boxes.size(), 9);
    EXPECT_EQ(plan.Areas[a].FirstLeaf, first);
    first += plan.Areas[a].Boxes.size();
  }
}

TEST(Plan, AnAreasPartitionAndTheLeafAtAPointAreTheSame)
{
  const Coordinates xy = makePointSet("clustered", 20000);
  const Plan plan = divide(inputOf(xy, 4), multiMaster({ 3, 2 }, { 4, 2 }));
  for (const Point2 p : asPoints(xy))
  {
    const Area& area = plan.Areas[std::size_t(1 + plan.Areas[0].Boxes.locate(p))];
    ASSERT_EQ(area.FirstLeaf + area.Boxes.locate(p), plan.Leaves.locate(p));
  }
}

TEST(Plan, AThresholdGivesDenseMajorPartitionsMoreMinorOnes)
{
  DistributedOptions options = multiMaster({ 4, 4 }, {});
  options.MinorDivision = Division::Threshold;
  options.Threshold = 100;
  const Coordinates xy = makePointSet("clustered", 20000);
  const Plan plan = divide(inputOf(xy, 4), options);
  std::set<PartitionIndex> sizes;
  for (std::size_t a = 1; a < plan.Areas.size(); ++a)
  {
    sizes.insert(plan.Areas[a].Boxes.size());
  }
  EXPECT_GT(sizes.size(), 1u);
}

TEST(Plan, ATreesRanksHaveEquallyManyPoints)
{
  constexpr int ranks = 4;
  const Coordinates xy = makePointSet("clustered", 40000);
  DistributedOptions options;
  options.Threshold = 500;
  const PlanInput input = inputOf(xy, ranks);
  Plan plan = divide(input, options);
  const std::vector<std::int64_t> counts = leafCounts(plan, xy);
  assign(plan, input, counts, options);
  for (const std::int64_t points : pointsOfRanks(plan, counts, ranks))
  {
    EXPECT_NEAR(double(points), 10000, 1000);
  }
}

TEST(Plan, GroupsAreProportionalToPointsUnlessEqualOnesAreRequested)
{
  constexpr int ranks = 8;
  const Coordinates xy = makePointSet("clustered", 40000);
  const PlanInput input = inputOf(xy, ranks);
  const auto heaviest = [&](GroupSizes groups)
  {
    DistributedOptions options = multiMaster({ 2, 2 }, { 8, 8 });
    options.Groups = groups;
    Plan plan = divide(input, options);
    const std::vector<std::int64_t> counts = leafCounts(plan, xy);
    assign(plan, input, counts, options);
    const std::vector<std::int64_t> points = pointsOfRanks(plan, counts, ranks);
    EXPECT_EQ(std::accumulate(points.begin(), points.end(), std::int64_t(0)), 40000);
    return *std::max_element(points.begin(), points.end());
  };
  EXPECT_LE(heaviest(GroupSizes::Proportional), heaviest(GroupSizes::Equal));
}

TEST(Plan, RanksHaveSimilarNumbersOfPointsOverAllMajorPartitions)
{
  const Coordinates xy = makePointSet("coast", 100000);
  for (const Division division : { Division::Tree, Division::Threshold })
  {
    for (int ranks = 2; ranks <= 8; ++ranks)
    {
      DistributedOptions options;
      options.Design = Masters::Multi;
      options.Major = { 4, 4 };
      options.MinorDivision = division;
      options.Threshold = 400;
      const PlanInput input = inputOf(xy, ranks);
      Plan plan = divide(input, options);
      const std::vector<std::int64_t> counts = leafCounts(plan, xy);
      assign(plan, input, counts, options);
      const std::vector<std::int64_t> points = pointsOfRanks(plan, counts, ranks);
      EXPECT_LT(*std::max_element(points.begin(), points.end()) * ranks, 115 * 1000) << ranks;
    }
  }
}

TEST(Plan, IsRestoredFromItsBytes)
{
  const Coordinates xy = makePointSet("uniform", 20000);
  const DistributedOptions options = multiMaster({ 2, 2 }, { 3, 3 });
  const PlanInput input = inputOf(xy, 3);
  Plan plan = divide(input, options);
  assign(plan, input, leafCounts(plan, xy), options);
  const auto back = unpacked<Plan>(packed(plan));
  EXPECT_EQ(back.Owners, plan.Owners);
  ASSERT_EQ(back.Areas.size(), plan.Areas.size());
  for (std::size_t a = 0; a < plan.Areas.size(); ++a)
  {
    EXPECT_EQ(back.Areas[a].Boxes.size(), plan.Areas[a].Boxes.size());
    EXPECT_EQ(back.Areas[a].FirstLeaf, plan.Areas[a].FirstLeaf);
    EXPECT_EQ(back.Areas[a].Lead, plan.Areas[a].Lead);
  }
  for (const Point2 p : asPoints(xy))
  {
    ASSERT_EQ(back.Leaves.locate(p), plan.Leaves.locate(p));
  }
}

TEST(Plan, MorePartitionsThanMemoryAllowsAreRefused)
{
  const PlanInput input = inputOf(makePointSet("uniform", 100), 2);
  EXPECT_THROW(divide(input, multiMaster({ 65536, 65536 }, { 1, 1 })), std::length_error);
  EXPECT_THROW(divide(input, multiMaster({ 64, 64 }, { 128, 128 })), std::length_error);
}

} // namespace
