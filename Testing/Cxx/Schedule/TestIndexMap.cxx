// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/IndexMap.h"

#include "Arrays/Random.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

namespace
{

using namespace tipp;

TEST(IndexMap, NumbersKeysInTheOrderOfInsertion)
{
  IndexMap map;
  EXPECT_EQ(0, map.insert(700).Index);
  EXPECT_EQ(1, map.insert(-1).Index);
  EXPECT_EQ(2, map.insert(INT64_MAX).Index);
  EXPECT_EQ(1, map.insert(-1).Index);
  EXPECT_EQ(3U, map.size());
}

TEST(IndexMap, TellsWhetherAKeyIsNew)
{
  IndexMap map;
  EXPECT_TRUE(map.insert(5).IsNew);
  EXPECT_FALSE(map.insert(5).IsNew);
}

TEST(IndexMap, FindsOnlyWhatWasInserted)
{
  IndexMap map;
  map.insert(0);
  map.insert(64);
  EXPECT_EQ(0, map.find(0));
  EXPECT_EQ(1, map.find(64));
  EXPECT_EQ(IndexMap::None, map.find(128));
}

TEST(IndexMap, IsEmptyAfterClear)
{
  IndexMap map;
  map.insert(3);
  map.clear();
  EXPECT_EQ(0U, map.size());
  EXPECT_EQ(IndexMap::None, map.find(3));
  EXPECT_EQ(0, map.insert(4).Index);
}

TEST(IndexMap, AgreesWithAnOrderedMapWhileItGrows)
{
  IndexMap map;
  for (int round = 0; round < 20; ++round)
  {
    map.clear();
    std::map<std::int64_t, std::int32_t> expected;
    Random random(std::uint64_t(round) + 1);
    for (int i = 0; i < 200 * round; ++i)
    {
      const std::int64_t key = random.index(100 * round) << (2 * round);
      const auto [entry, isNew] = expected.emplace(key, std::int32_t(expected.size()));
      const auto inserted = map.insert(key);
      ASSERT_EQ(isNew, inserted.IsNew);
      ASSERT_EQ(entry->second, inserted.Index);
    }
    for (const auto& [key, index] : expected)
    {
      ASSERT_EQ(index, map.find(key));
    }
  }
}

} // namespace
