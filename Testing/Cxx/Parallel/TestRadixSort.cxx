// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/Sort.h"

#include "Arrays/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace
{

using namespace tipp;

/// Words whose upper halves are at most `largest`, with many repetitions, and whose lower halves
/// count them.
std::vector<std::uint64_t> makeWords(std::size_t count, std::uint32_t largest)
{
  Random random(7);
  std::vector<std::uint64_t> words;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto key = std::uint64_t(random.index(std::int64_t(largest) + 1));
    words.push_back((i % 3 == 0 ? largest : key) << 32 | i);
  }
  return words;
}

TEST(RadixSort, AgreesWithStableSort)
{
  for (const std::uint32_t largest :
    { 0U, 1U, 4095U, 4096U, 10000000U, (1U << 24) - 1, 1U << 24, UINT32_MAX })
  {
    for (const std::size_t count : { 0, 1, 2, 1000, 70000 })
    {
      for (const int threads : { 1, 3 })
      {
        std::vector<std::uint64_t> words = makeWords(count, largest);
        auto expected = words;
        std::stable_sort(expected.begin(), expected.end(),
          [](std::uint64_t a, std::uint64_t b) { return a >> 32 < b >> 32; });
        sortByUpperHalf(words, threads);
        EXPECT_EQ(expected, words) << largest << " " << count << " " << threads;
      }
    }
  }
}

} // namespace
