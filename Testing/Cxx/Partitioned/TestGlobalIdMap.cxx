// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PieceFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using tipp::GlobalIdMap;

namespace
{

void expectFinds(const std::vector<std::int64_t>& ids)
{
  const GlobalIdMap map(ids.data(), nullptr, ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    ASSERT_EQ(std::int64_t(i), map.find(ids[i]));
    if (!std::binary_search(ids.begin(), ids.end(), ids[i] + 1))
    {
      ASSERT_EQ(-1, map.find(ids[i] + 1));
    }
  }
  EXPECT_EQ(-1, map.find(-1));
  EXPECT_EQ(-1, map.find(std::int64_t(1) << 62));
}

TEST(GlobalIdMap, FindsIdsWithoutGaps)
{
  std::vector<std::int64_t> ids;
  for (std::int64_t i = 0; i < 1000; ++i)
  {
    ids.push_back(70 + i);
  }
  expectFinds(ids);
}

TEST(GlobalIdMap, FindsScatteredIds)
{
  std::mt19937_64 random(1);
  std::vector<std::int64_t> ids;
  for (int i = 0; i < 1000; ++i)
  {
    ids.push_back(std::int64_t(random() % 1000000));
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  expectFinds(ids);
}

TEST(GlobalIdMap, FindsRunsBetweenWideGapsOfMoreThan32Bits)
{
  std::vector<std::int64_t> ids;
  for (std::int64_t run = 0; run < 5; ++run)
  {
    for (std::int64_t i = 0; i < 300; ++i)
    {
      ids.push_back((run << 40) + i);
    }
  }
  expectFinds(ids);
}

TEST(GlobalIdMap, FindsTheExtremeIds)
{
  using Limits = std::numeric_limits<std::int64_t>;
  const std::vector<std::int64_t> ids{ Limits::min(), 0, Limits::max() };
  const GlobalIdMap map(ids.data(), nullptr, ids.size());
  EXPECT_EQ(0, map.find(Limits::min()));
  EXPECT_EQ(1, map.find(0));
  EXPECT_EQ(2, map.find(Limits::max()));
  EXPECT_EQ(-1, map.find(Limits::max() - 1));
}

TEST(GlobalIdMap, FindsNothingInAnEmptyMap)
{
  const GlobalIdMap map(nullptr, nullptr, 0);
  EXPECT_EQ(-1, map.find(0));
  const GlobalIdMap none;
  EXPECT_EQ(-1, none.find(5));
}

TEST(GlobalIdMap, ReturnsTheGivenValues)
{
  const std::vector<std::int64_t> ids{ 3, 5, 900 };
  const std::vector<std::int64_t> values{ 2, 0, 1 };
  const GlobalIdMap map(ids.data(), values.data(), ids.size());
  const std::vector<std::int64_t> asked{ 900, 3, 3, 5 };
  std::vector<std::int32_t> found(asked.size());
  EXPECT_TRUE(map.translate(asked.data(), asked.size(), found.data()));
  EXPECT_EQ((std::vector<std::int32_t>{ 1, 2, 2, 0 }), found);
}

TEST(GlobalIdMap, ReportsAnIdWithoutValue)
{
  const std::vector<std::int64_t> ids{ 3, 5 };
  const GlobalIdMap map(ids.data(), nullptr, ids.size());
  const std::vector<std::int64_t> asked{ 3, 4 };
  std::vector<std::int64_t> found(asked.size());
  EXPECT_FALSE(map.translate(asked.data(), asked.size(), found.data()));
}

} // namespace
