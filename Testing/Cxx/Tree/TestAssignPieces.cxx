// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using tipp::assignPieces;
using Starts = std::vector<std::size_t>;

namespace
{

std::int64_t heaviest(const std::vector<std::int64_t>& weights, const Starts& starts)
{
  std::int64_t most = 0;
  for (std::size_t r = 0; r + 1 < starts.size(); ++r)
  {
    std::int64_t sum = 0;
    for (std::size_t i = starts[r]; i < starts[r + 1]; ++i)
    {
      sum += weights[i];
    }
    most = std::max(most, sum);
  }
  return most;
}

// The smallest possible weight of the heaviest run, by a search of all divisions.
std::int64_t best(const std::vector<std::int64_t>& weights, std::size_t begin, int ranks)
{
  std::int64_t sum = 0;
  std::int64_t result = INT64_MAX;
  for (std::size_t end = begin; end <= weights.size(); ++end)
  {
    if (ranks == 1 ? end == weights.size() : true)
    {
      result = std::min(
        result, std::max(sum, ranks == 1 ? std::int64_t(0) : best(weights, end, ranks - 1)));
    }
    sum += end < weights.size() ? weights[end] : 0;
  }
  return result;
}

} // namespace

TEST(AssignPieces, EqualWeightsGiveEqualRuns)
{
  EXPECT_EQ(assignPieces({ 5, 5, 5, 5, 5, 5 }, 3), (Starts{ 0, 2, 4, 6 }));
}

TEST(AssignPieces, OneRankHasAll)
{
  EXPECT_EQ(assignPieces({ 1, 2, 3 }, 1), (Starts{ 0, 3 }));
  EXPECT_EQ(assignPieces({ 1, 2, 3 }, 0), (Starts{ 0, 3 }));
}

TEST(AssignPieces, AHeavyPieceIsARunOfItsOwn)
{
  EXPECT_EQ(assignPieces({ 1, 1, 100, 1, 1 }, 3), (Starts{ 0, 2, 3, 5 }));
}

TEST(AssignPieces, MoreRanksThanPiecesGiveEmptyRuns)
{
  EXPECT_EQ(assignPieces({ 7, 7 }, 4), (Starts{ 0, 1, 2, 2, 2 }));
  EXPECT_EQ(assignPieces({}, 2), (Starts{ 0, 0, 0 }));
}

TEST(AssignPieces, PiecesWithoutWeightAreAssignedToo)
{
  EXPECT_EQ(assignPieces({ 0, 0, 0, 0 }, 2).back(), 4u);
  EXPECT_EQ(assignPieces({ -3, 4, -3 }, 2).back(), 3u);
}

TEST(AssignPieces, TheHeaviestRunIsAsLightAsPossibleAndNoRunIsEmpty)
{
  std::mt19937 engine(1);
  for (int i = 0; i < 300; ++i)
  {
    std::vector<std::int64_t> weights(1 + engine() % 9);
    std::generate(weights.begin(), weights.end(), [&] { return engine() % 20; });
    const int ranks = 1 + static_cast<int>(engine() % 5);
    const Starts starts = assignPieces(weights, ranks);
    ASSERT_EQ(starts.size(), static_cast<std::size_t>(ranks) + 1);
    EXPECT_EQ(starts.front(), 0u);
    EXPECT_EQ(starts.back(), weights.size());
    EXPECT_TRUE(std::is_sorted(starts.begin(), starts.end()));
    EXPECT_EQ(heaviest(weights, starts), best(weights, 0, ranks));
    const auto filled = static_cast<std::size_t>(std::count_if(starts.begin() + 1, starts.end(),
      [&, last = std::size_t(0)](std::size_t start) mutable
      { return std::exchange(last, start) < start; }));
    EXPECT_EQ(filled, std::min(weights.size(), static_cast<std::size_t>(ranks)));
  }
}
