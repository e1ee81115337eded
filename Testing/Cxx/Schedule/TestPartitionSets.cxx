// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/BoundaryCells.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace
{

using namespace tipp;
using List = std::vector<PartitionIndex>;

std::uint32_t numberOf(PartitionSets& sets, const List& list)
{
  return sets.number(list.data(), list.data() + list.size());
}

TEST(PartitionSets, NumbersListsInOrderOfFirstAppearance)
{
  PartitionSets sets;
  EXPECT_EQ(0U, numberOf(sets, { 3, 4 }));
  EXPECT_EQ(1U, numberOf(sets, {}));
  EXPECT_EQ(2U, numberOf(sets, { 3 }));
  EXPECT_EQ(0U, numberOf(sets, { 3, 4 }));
  EXPECT_EQ(1U, numberOf(sets, {}));
  EXPECT_EQ(3U, sets.size());
}

TEST(PartitionSets, KeepsTheContentOfAList)
{
  PartitionSets sets;
  std::map<List, std::uint32_t> expected;
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i)
  {
    List list(random() % 5);
    for (PartitionIndex& p : list)
    {
      p = PartitionIndex(random() % 7);
    }
    const auto entry = expected.emplace(list, std::uint32_t(expected.size()));
    ASSERT_EQ(entry.first->second, numberOf(sets, list));
  }
  ASSERT_EQ(expected.size(), sets.size());
  for (const auto& entry : expected)
  {
    EXPECT_EQ(entry.first, List(sets.begin(entry.second), sets.end(entry.second)));
  }
}

} // namespace
