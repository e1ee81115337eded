// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/ConflictGraph.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

/// Sorting each node's neighbours is faster than sorting all pairs: they are few, and in the cache.
void ConflictGraph::add(const std::vector<Pair>& pairs)
{
  std::vector<std::size_t> ends(this->size() + 1, 0);
  for (std::size_t i = 0; i < this->size(); ++i)
  {
    const auto p = static_cast<PartitionIndex>(i);
    ends[i + 1] = std::size_t(this->end(p) - this->begin(p));
  }
  for (const auto& [a, b] : pairs)
  {
    ++ends[std::size_t(a) + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<PartitionIndex> all(ends.back());
  // Now the position of each node's next neighbour; in the end one past its last.
  for (std::size_t i = 0; i < this->size(); ++i)
  {
    const auto p = static_cast<PartitionIndex>(i);
    ends[i] = std::size_t(
      std::copy(this->begin(p), this->end(p), all.begin() + std::ptrdiff_t(ends[i])) - all.begin());
  }
  for (const auto& [a, b] : pairs)
  {
    all[ends[std::size_t(a)]++] = b;
  }
  std::size_t begin = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < this->size(); ++i)
  {
    const auto first = all.begin() + std::ptrdiff_t(begin);
    const auto last = all.begin() + std::ptrdiff_t(ends[i]);
    begin = ends[i];
    std::sort(first, last);
    const auto to = all.begin() + std::ptrdiff_t(kept);
    kept = std::size_t(std::unique_copy(first, last, to) - all.begin());
    this->Ends[i] = kept;
  }
  all.resize(kept);
  this->Neighbours = std::move(all);
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
  std::vector<PartitionIndex> takenFor; // by colour: the last node that could not have it
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
