// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/BlockCache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace
{

using tipp::BlockCache;

/// The cache as a plain list, with the most recently used block last.
class Model
{
public:
  explicit Model(std::size_t slots)
    : Slots(slots)
  {
  }

  bool isMiss(std::uint64_t block)
  {
    const auto found = std::find(this->Blocks.begin(), this->Blocks.end(), block);
    const bool miss = found == this->Blocks.end();
    if (!miss)
    {
      this->Blocks.erase(found);
    }
    else if (this->Blocks.size() == this->Slots)
    {
      this->Blocks.erase(this->Blocks.begin());
    }
    this->Blocks.push_back(block);
    return miss;
  }

private:
  std::size_t Slots;
  std::vector<std::uint64_t> Blocks;
};

} // namespace

TEST(BlockCache, ReplacesTheLeastRecentlyUsedBlock)
{
  BlockCache cache(2);
  EXPECT_TRUE(cache.use(10).Miss);
  EXPECT_TRUE(cache.use(20).Miss);
  EXPECT_FALSE(cache.use(10).Miss);
  EXPECT_TRUE(cache.use(30).Miss);
  EXPECT_FALSE(cache.use(10).Miss);
  EXPECT_TRUE(cache.use(20).Miss);
}

TEST(BlockCache, AgreesWithAListOnRandomUse)
{
  for (const std::uint32_t slots : { 1U, 2U, 3U, 16U, 100U })
  {
    for (const std::uint64_t blocks : { 2U, 5U, 40U, 300U })
    {
      std::mt19937_64 random(slots + blocks);
      BlockCache cache(slots);
      Model model(slots);
      std::map<std::uint64_t, std::uint32_t> held;
      for (int i = 0; i < 5000; ++i)
      {
        // Half of the blocks have ids that collide in the hash table.
        const std::uint64_t block = random() % blocks << (i % 2 ? 0 : 40);
        const BlockCache::UsedSlot found = cache.use(block);
        ASSERT_EQ(model.isMiss(block), found.Miss) << i;
        ASSERT_LT(found.Slot, slots);
        if (!found.Miss)
        {
          ASSERT_EQ(held[block], found.Slot);
        }
        held[block] = found.Slot;
      }
    }
  }
}
