// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/CountingSort.h"

#include "Arrays/Random.h"
#include "Parallel/ParallelFor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;

using Groups = GroupedItems<std::int64_t, std::uint32_t>;

std::vector<std::int64_t> itemsOf(const Groups& groups, std::size_t group)
{
  return { groups.begin(group), groups.end(group) };
}

TEST(CountingSort, KeepsTheOrderWithinAGroupOnOneThread)
{
  const std::vector<std::pair<std::size_t, std::int64_t>> given = { { 2, 7 }, { 0, 5 }, { 2, 3 },
    { 0, 9 }, { 2, 8 } };
  const Groups groups(4, 1,
    [&](const auto& visit)
    {
      for (const auto& [group, item] : given)
      {
        visit(group, item);
      }
    });
  EXPECT_EQ(4U, groups.groups());
  EXPECT_EQ(5U, groups.size());
  EXPECT_EQ((std::vector<std::int64_t>{ 5, 9 }), itemsOf(groups, 0));
  EXPECT_EQ((std::vector<std::int64_t>{}), itemsOf(groups, 1));
  EXPECT_EQ((std::vector<std::int64_t>{ 7, 3, 8 }), itemsOf(groups, 2));
  EXPECT_EQ((std::vector<std::int64_t>{}), itemsOf(groups, 3));
  EXPECT_EQ(3, groups[3]);
}

TEST(CountingSort, GroupsAllItemsOnSeveralThreads)
{
  constexpr std::size_t most = 100;
  constexpr std::int64_t count = 100000;
  Random random(1);
  std::vector<std::size_t> groupOf;
  for (std::int64_t i = 0; i < count; ++i)
  {
    groupOf.push_back(std::size_t(random.index(most)));
  }
  constexpr int threads = 4;
  const Groups groups(most, threads,
    [&](const auto& visit)
    {
      forChunks(count, 1000, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        {
          for (std::int64_t i = begin; i < end; ++i)
          {
            visit(groupOf[std::size_t(i)], i);
          }
        });
    });
  ASSERT_EQ(std::size_t(count), groups.size());
  for (std::size_t group = 0; group < most; ++group)
  {
    std::vector<std::int64_t> items = itemsOf(groups, group);
    std::sort(items.begin(), items.end());
    std::vector<std::int64_t> expected;
    for (std::int64_t i = 0; i < count; ++i)
    {
      if (groupOf[std::size_t(i)] == group)
      {
        expected.push_back(i);
      }
    }
    ASSERT_EQ(expected, items);
  }
}

TEST(CountingSort, HasNoItemsWithoutGroups)
{
  const auto none = [](const auto&) {};
  EXPECT_EQ(0U, Groups().size());
  EXPECT_EQ(0U, Groups(0, 1, none).size());
  EXPECT_EQ(0U, Groups(3, 2, none).size());
}

TEST(CountingSort, TurnsCountsOfSharesIntoIndices)
{
  std::vector<std::vector<std::uint32_t>> counts = { { 2, 0, 1 }, { 1, 3, 0 } };
  EXPECT_EQ((std::vector<std::uint32_t>{ 0, 3, 6, 7 }), countsToIndices(3, counts));
  EXPECT_EQ((std::vector<std::uint32_t>{ 0, 3, 6 }), counts[0]);
  EXPECT_EQ((std::vector<std::uint32_t>{ 2, 3, 7 }), counts[1]);
}

} // namespace
