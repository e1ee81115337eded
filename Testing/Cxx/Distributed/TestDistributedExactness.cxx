// SPDX-License-Identifier: BSD-3-Clause
// The triangles are those of CGAL for every input, number of ranks, design of masters, division and
// schedule.
#include "DistributedTesting.h"

#include <cctype>

namespace
{

using namespace tipp;
using namespace tipp::test;

struct Design
{
  std::string Name;
  DistributedOptions Options;
};

DistributedOptions make(Masters masters, GridSize major, Division division, GridSize minor,
  std::int64_t threshold, GroupSizes groups = GroupSizes::Proportional)
{
  return { masters, major, division, minor, threshold, groups, RankSchedule::Dynamic, 0, 0, {} };
}

const Design designs[] = {
  { "automatic", {} },
  { "NoMasterGrid8x8", make(Masters::Auto, {}, Division::Grid, { 8, 8 }, 0) },
  { "NoMasterTree", make(Masters::Auto, {}, Division::Tree, {}, 100) },
  { "NoMasterThresholdEqual",
    make(Masters::Auto, {}, Division::Threshold, {}, 60, GroupSizes::Equal) },
  { "SingleGrid8x8", make(Masters::Single, {}, Division::Grid, { 8, 8 }, 0) },
  { "SingleGrid16x3Equal",
    make(Masters::Single, {}, Division::Grid, { 16, 3 }, 0, GroupSizes::Equal) },
  { "SingleTree", make(Masters::Single, {}, Division::Tree, {}, 100) },
  { "MultiGrid4x4x4x4", make(Masters::Multi, { 4, 4 }, Division::Grid, { 4, 4 }, 0) },
  { "MultiGrid3x2x5x3Equal",
    make(Masters::Multi, { 3, 2 }, Division::Grid, { 5, 3 }, 0, GroupSizes::Equal) },
  { "MultiThreshold", make(Masters::Multi, { 4, 4 }, Division::Threshold, {}, 60) },
  { "MultiTree", make(Masters::Multi, {}, Division::Tree, {}, 60) },
};

struct PointSet
{
  std::string Name;
  std::size_t Count;
};

class DistributedExactness : public testing::TestWithParam<std::tuple<PointSet, Design>>
{
};

TEST_P(DistributedExactness, IsCgalsForAllSchedules)
{
  const auto& [set, design] = GetParam();
  const Coordinates xy = makePointSet(set.Name, set.Count);
  for (const RankSchedule order :
    { RankSchedule::Stages, RankSchedule::ProducerConsumer, RankSchedule::Dynamic })
  {
    if (order != RankSchedule::Dynamic && design.Options.isMasterless())
    {
      continue; // schedules with barriers need a master, as in the designs below
    }
    DistributedOptions options = design.Options;
    options.Order = order;
    options.Threads = 1 + ranks() % 2;
    const Gathered result = triangulateShares(xy, Share::RoundRobin, options);
    if (rank() == 0)
    {
      EXPECT_TRUE(matches(xy, result, cachedReference(set.Name, xy))) << "schedule " << int(order);
    }
  }
}

const PointSet pointSets[] = { { "uniform", 4000 }, { "clustered", 4000 }, { "coast", 4000 },
  { "lattice", 3600 }, { "duplicates", 4000 }, { "duplicate-lattice", 4000 },
  { "with-rejected", 3000 }, { "two-clusters", 3000 }, { "collinear-and-one", 1000 } };

INSTANTIATE_TEST_SUITE_P(PointSets, DistributedExactness,
  testing::Combine(testing::ValuesIn(pointSets), testing::ValuesIn(designs)),
  [](const auto& info)
  {
    std::string name = std::get<0>(info.param).Name + "_" + std::get<1>(info.param).Name;
    for (char& c : name)
    {
      c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    }
    return name;
  });

} // namespace
