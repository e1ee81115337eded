// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/BlockCache.h"

#include <gtest/gtest.h>

#include <ostream>

namespace tipp
{

bool operator==(const TupleRun& a, const TupleRun& b)
{
  return a.First == b.First && a.Size == b.Size;
}

std::ostream& operator<<(std::ostream& stream, const TupleRun& run)
{
  return stream << run.First << "+" << run.Size;
}

} // namespace tipp

namespace
{

using tipp::RunPlan;
using tipp::runsOfBlocks;
using tipp::runsOfIds;
using tipp::TupleRun;
using Runs = std::vector<TupleRun>;
using Groups = std::vector<std::size_t>;

} // namespace

TEST(Runs, OfNeighbouringBlocksAreOne)
{
  EXPECT_EQ((Runs{ { 110, 20 }, { 140, 5 } }), runsOfBlocks({ 0, 1, 1, 0, 1 }, 10, 100, 144, 0));
}

TEST(Runs, WithASmallGapBecomeOne)
{
  EXPECT_EQ((Runs{ { 0, 10 }, { 20, 10 } }), runsOfBlocks({ 1, 0, 1 }, 10, 0, 29, 10));
  EXPECT_EQ((Runs{ { 0, 30 } }), runsOfBlocks({ 1, 0, 1 }, 10, 0, 29, 11));
}

TEST(Runs, OfIdsContainEachOnce)
{
  const std::vector<std::pair<std::int64_t, std::uint32_t>> ids{ { 3, 0 }, { 4, 9 }, { 9, 1 },
    { 9, 5 }, { 100, 2 } };
  EXPECT_EQ((Runs{ { 3, 2 }, { 9, 1 }, { 100, 1 } }), runsOfIds(ids, 0));
  EXPECT_EQ((Runs{ { 3, 7 }, { 100, 1 } }), runsOfIds(ids, 10));
}

TEST(Runs, ThatFitAreOneGroup)
{
  const RunPlan plan({ { 0, 10 }, { 50, 10 } }, 20, 10, 0);
  EXPECT_EQ((Groups{ 0, 2 }), plan.Starts);
  EXPECT_EQ((Runs{ { 0, 10 }, { 50, 10 } }), plan.Runs);
}

TEST(Runs, ThatDoNotFitAreCutAtBlocks)
{
  const RunPlan plan({ { 5, 40 }, { 105, 20 } }, 25, 10, 5);
  EXPECT_EQ((Groups{ 0, 1, 2, 3 }), plan.Starts);
  EXPECT_EQ((Runs{ { 5, 20 }, { 25, 20 }, { 105, 20 } }), plan.Runs);
}

TEST(Runs, InGroupsCoverTheSameTuplesWithinM)
{
  for (const std::int64_t m : { 4, 5, 8, 13, 64, 1000 })
  {
    const std::vector<char> active{ 1, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 0, 1 };
    const RunPlan plan(runsOfBlocks(active, 4, 3, 3 + 49, 1), m, 4, 3);
    const Runs& runs = plan.Runs;
    const Groups& groups = plan.Starts;
    std::vector<char> covered(active.size() * 4, 0);
    EXPECT_EQ(runs.size(), groups.back());
    for (std::size_t group = 0; group + 1 < groups.size(); ++group)
    {
      std::int64_t size = 0;
      EXPECT_LT(groups[group], groups[group + 1]);
      for (std::size_t i = groups[group]; i < groups[group + 1]; ++i)
      {
        EXPECT_EQ(0, (runs[i].First - 3) % 4);
        size += runs[i].Size;
        for (std::int64_t at = runs[i].First; at < runs[i].First + runs[i].Size; ++at)
        {
          EXPECT_EQ(0, covered[std::size_t(at - 3)]++);
        }
      }
      EXPECT_LE(size, m);
    }
    for (std::size_t i = 0; i < 50; ++i)
    {
      EXPECT_EQ(active[i / 4], covered[i]) << m << " " << i;
    }
  }
}
