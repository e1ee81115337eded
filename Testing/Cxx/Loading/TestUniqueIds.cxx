// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/BlockCache.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace
{

using tipp::UniqueIds;

TEST(UniqueIds, AscendAndNumberTheIdsOfTheChunk)
{
  std::mt19937_64 random(3);
  for (const std::int64_t most : { std::int64_t(1), std::int64_t(50), std::int64_t(1) << 60 })
  {
    std::vector<std::int64_t> ids(1000);
    for (std::int64_t& id : ids)
    {
      id = std::int64_t(random() % std::uint64_t(most));
    }
    const UniqueIds unique(ids.data(), ids.size());
    const std::set<std::int64_t> expected(ids.begin(), ids.end());
    ASSERT_EQ(expected.size(), unique.Sorted.size());
    std::vector<std::int64_t> byNumber(expected.size());
    auto next = expected.begin();
    for (const auto& [id, number] : unique.Sorted)
    {
      ASSERT_EQ(*next++, id);
      byNumber.at(number) = id;
    }
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      ASSERT_EQ(ids[i], byNumber.at(unique.Numbers[i]));
    }
  }
}

TEST(UniqueIds, OfNothingAreNone)
{
  EXPECT_TRUE(UniqueIds(nullptr, 0).Sorted.empty());
}

} // namespace
