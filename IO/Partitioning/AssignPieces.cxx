// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/AssignPieces.h"

#include <algorithm>

namespace tipp
{
namespace
{

std::int64_t weightOf(const std::vector<std::int64_t>& weights, std::size_t piece)
{
  return std::max<std::int64_t>(weights[piece], 0);
}

// Greedy runs of weight at most `most`, leaving at least one piece for each later rank. The last
// rank gets the rest.
std::vector<std::size_t> runsOf(
  const std::vector<std::int64_t>& weights, std::size_t ranks, std::int64_t most)
{
  std::vector<std::size_t> starts = { 0 };
  std::size_t piece = 0;
  for (std::size_t rank = 0; rank + 1 < ranks; ++rank)
  {
    const std::size_t later = ranks - 1 - rank;
    const std::size_t end = weights.size() > later ? weights.size() - later : 0;
    std::int64_t sum = 0;
    const std::size_t first = piece;
    while (piece < end && (piece == first || weightOf(weights, piece) <= most - sum))
    {
      sum += weightOf(weights, piece);
      ++piece;
    }
    // With fewer pieces than ranks, the first ranks get one each.
    piece = std::min(std::max(piece, first + 1), weights.size());
    starts.push_back(piece);
  }
  starts.push_back(weights.size());
  return starts;
}

std::int64_t heaviest(
  const std::vector<std::int64_t>& weights, const std::vector<std::size_t>& starts)
{
  std::int64_t most = 0;
  for (std::size_t rank = 0; rank + 1 < starts.size(); ++rank)
  {
    std::int64_t sum = 0;
    for (std::size_t piece = starts[rank]; piece < starts[rank + 1]; ++piece)
    {
      sum += weightOf(weights, piece);
    }
    most = std::max(most, sum);
  }
  return most;
}

} // namespace

std::vector<std::size_t> assignPieces(const std::vector<std::int64_t>& weights, int ranks)
{
  const auto count = static_cast<std::size_t>(std::max(ranks, 1));
  std::int64_t low = 0;
  std::int64_t high = 0;
  for (std::size_t piece = 0; piece < weights.size(); ++piece)
  {
    low = std::max(low, weightOf(weights, piece));
    high += weightOf(weights, piece);
  }
  // Bisection for the least possible weight of the heaviest run.
  while (low < high)
  {
    const std::int64_t most = low + (high - low) / 2;
    if (heaviest(weights, runsOf(weights, count, most)) <= most)
    {
      high = most;
    }
    else
    {
      low = most + 1;
    }
  }
  return runsOf(weights, count, low);
}

} // namespace tipp
