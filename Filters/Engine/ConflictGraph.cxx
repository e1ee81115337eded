// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/ConflictGraph.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

void ConflictGraph::makeUnique(std::vector<Pair>& pairs)
{
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

ConflictGraph::ConflictGraph(std::size_t count, std::vector<Pair> pairs)
  : Ends(count, 0)
{
  makeUnique(pairs);
  this->Neighbours.reserve(pairs.size());
  for (const Pair pair : pairs)
  {
    this->Neighbours.push_back(static_cast<PartitionIndex>(pair & 0xffffffffU));
    this->Ends[std::size_t(pair >> 32)] = this->Neighbours.size();
  }
  std::partial_sum(this->Ends.begin(), this->Ends.end(), this->Ends.begin(),
    [](std::size_t before, std::size_t end) { return std::max(before, end); });
}

std::vector<std::uint32_t> ConflictGraph::colours() const
{
  std::vector<PartitionIndex> order(this->size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [this](PartitionIndex a, PartitionIndex b)
    { return this->end(a) - this->begin(a) > this->end(b) - this->begin(b); });
  constexpr std::uint32_t none = ~0U;
  std::vector<std::uint32_t> colours(this->size(), none);
  std::vector<PartitionIndex> takenFor; // of each colour, which it was last refused for
  for (const PartitionIndex p : order)
  {
    for (const PartitionIndex* neighbour = this->begin(p); neighbour != this->end(p); ++neighbour)
    {
      const std::uint32_t taken = colours[std::size_t(*neighbour)];
      if (taken != none)
      {
        takenFor[taken] = p;
      }
    }
    const auto free = std::find_if(
      takenFor.begin(), takenFor.end(), [p](PartitionIndex taken) { return taken != p; });
    colours[std::size_t(p)] = static_cast<std::uint32_t>(free - takenFor.begin());
    if (free == takenFor.end())
    {
      takenFor.push_back(-1);
    }
  }
  return colours;
}

} // namespace tipp
