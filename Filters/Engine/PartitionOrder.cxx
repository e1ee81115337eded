// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/PartitionOrder.h"

#include "Arrays/SortUnique.h"
#include "Triangulation/BoundaryTriangles.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace tipp
{

void ConflictGraph::add(const std::vector<Pair>& pairs)
{
  for (const auto& [a, b] : pairs)
  {
    this->neighbours(a).push_back(b);
    this->neighbours(b).push_back(a);
  }
  this->Count = 0;
  for (std::vector<PartitionIndex>& neighbours : this->Neighbours)
  {
    sortUnique(neighbours);
    this->Count += neighbours.size();
  }
}

std::vector<std::uint32_t> ConflictGraph::colours() const
{
  std::vector<PartitionIndex> order(this->size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [this](PartitionIndex a, PartitionIndex b)
    { return this->neighbours(a).size() > this->neighbours(b).size(); });
  constexpr std::uint32_t none = ~0U;
  std::vector<std::uint32_t> colours(this->size(), none);
  std::vector<PartitionIndex> takenFor; // by colour: the last node for which it was taken
  for (const PartitionIndex p : order)
  {
    for (const PartitionIndex neighbour : this->neighbours(p))
    {
      const std::uint32_t taken = colours[std::size_t(neighbour)];
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

namespace
{

bool isIn(PartitionIndex p, const PartitionSets& sets, std::uint32_t set)
{
  return std::find(sets.begin(set), sets.end(set), p) != sets.end(set);
}

/// Adds the pairs of members of a set.
void addConflicts(
  const PartitionSets& sets, std::uint32_t set, std::vector<ConflictGraph::Pair>& pairs)
{
  for (const PartitionIndex* a = sets.begin(set); a != sets.end(set); ++a)
  {
    for (const PartitionIndex* b = sets.begin(set); b != a; ++b)
    {
      pairs.emplace_back(*a, *b);
    }
  }
}

/// Adds the pairs of a member only of the set `one` and a member only of the set `other`.
void addConflicts(const PartitionSets& sets, std::uint32_t one, std::uint32_t other,
  std::vector<ConflictGraph::Pair>& pairs)
{
  for (const PartitionIndex* a = sets.begin(one); a != sets.end(one); ++a)
  {
    if (isIn(*a, sets, other))
    {
      continue;
    }
    for (const PartitionIndex* b = sets.begin(other); b != sets.end(other); ++b)
    {
      if (!isIn(*b, sets, one))
      {
        pairs.emplace_back(*a, *b);
      }
    }
  }
}

} // namespace

std::size_t mostConflicts(std::size_t partitions)
{
  constexpr std::size_t mostOfAPartition = 256;
  return mostOfAPartition * std::max<std::size_t>(16384, partitions);
}

std::optional<ConflictGraph> findConflicts(const MetPartitions& initialMesh, std::size_t partitions)
{
  constexpr std::size_t most = std::size_t(1) << 22; // pairs collected before they are added
  const std::size_t limit = mostConflicts(partitions);
  const PartitionSets& sets = initialMesh.Sets;
  ConflictGraph conflicts(partitions);
  std::vector<ConflictGraph::Pair> pairs;
  const auto isWithinLimit = [&]
  {
    if (2 * pairs.size() > conflicts.neighbourCount() + most)
    {
      conflicts.add(pairs);
      pairs.clear();
    }
    return conflicts.neighbourCount() <= limit;
  };
  for (std::uint32_t set = 0; set < sets.size(); ++set)
  {
    const std::size_t size = std::size_t(sets.end(set) - sets.begin(set));
    if (size * size > limit)
    {
      return std::nullopt;
    }
    addConflicts(sets, set, pairs);
    if (!isWithinLimit())
    {
      return std::nullopt;
    }
  }
  for (const auto& [one, other] : initialMesh.AdjacentSets)
  {
    addConflicts(sets, one, other, pairs);
    if (!isWithinLimit())
    {
      return std::nullopt;
    }
  }
  conflicts.add(pairs);
  return conflicts.neighbourCount() <= limit ? std::optional<ConflictGraph>(std::move(conflicts))
                                             : std::nullopt;
}

PartitionOrder::PartitionOrder(
  const std::vector<char>& isUsed, std::optional<ConflictGraph> conflicts)
  : Positions(isUsed.size(), 0)
  , Colours(isUsed.size(), 0)
  , Total(!conflicts)
{
  for (std::size_t p = 0; p < isUsed.size(); ++p)
  {
    if (isUsed[p])
    {
      this->Sequence.push_back(static_cast<PartitionIndex>(p));
    }
  }
  if (conflicts)
  {
    this->Conflicts = std::move(*conflicts);
  }
  this->colour();
  this->sort({});
}

void PartitionOrder::setWindows(const std::vector<std::int32_t>& windows)
{
  this->sort(windows);
}

/// Sorts the partitions. Without windows, all partitions are in one window.
void PartitionOrder::sort(const std::vector<std::int32_t>& windows)
{
  const auto key = [&](PartitionIndex p)
  { return std::make_tuple(windows.empty() ? 0 : windows[std::size_t(p)], this->colourOf(p), p); };
  std::sort(this->Sequence.begin(), this->Sequence.end(),
    [&](PartitionIndex a, PartitionIndex b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < this->Sequence.size(); ++i)
  {
    this->Positions[std::size_t(this->Sequence[i])] = static_cast<std::uint32_t>(i);
  }
  const auto isBefore = [this](PartitionIndex a, PartitionIndex b)
  { return this->position(a) < this->position(b); };
  this->EarlierCounts.clear();
  for (PartitionIndex p = 0; std::size_t(p) < this->Conflicts.size(); ++p)
  {
    std::vector<PartitionIndex>& all = this->Conflicts.neighbours(p);
    std::sort(all.begin(), all.end(), isBefore);
    this->EarlierCounts.push_back(
      std::size_t(std::lower_bound(all.begin(), all.end(), p, isBefore) - all.begin()));
  }
  this->sortByUrgency(windows);
}

void PartitionOrder::sortByUrgency(const std::vector<std::int32_t>& windows)
{
  this->Urgency = this->Sequence;
  if (this->Total)
  {
    return; // one chain
  }
  std::vector<std::int32_t> chains(this->Positions.size(), 0); // longest chain from each partition
  for (auto p = this->Sequence.rbegin(); p != this->Sequence.rend(); ++p)
  {
    for (const PartitionIndex q : this->later(*p))
    {
      chains[std::size_t(*p)] = std::max(chains[std::size_t(*p)], 1 + chains[std::size_t(q)]);
    }
  }
  const auto key = [&](PartitionIndex p) {
    return std::make_pair(windows.empty() ? 0 : windows[std::size_t(p)], -chains[std::size_t(p)]);
  };
  std::stable_sort(this->Urgency.begin(), this->Urgency.end(),
    [&](PartitionIndex a, PartitionIndex b) { return key(a) < key(b); });
}

void PartitionOrder::colour()
{
  if (this->Total)
  {
    this->ColourSizes.assign(this->Sequence.size(), 1);
    for (std::size_t i = 0; i < this->Sequence.size(); ++i)
    {
      this->Colours[std::size_t(this->Sequence[i])] = static_cast<std::uint32_t>(i);
    }
    return;
  }
  this->Colours = this->Conflicts.colours();
  for (const PartitionIndex p : this->Sequence)
  {
    this->ColourSizes.resize(std::max(this->ColourSizes.size(), this->colourOf(p) + 1), 0);
    ++this->ColourSizes[this->colourOf(p)];
  }
}

PartitionOrder::Range PartitionOrder::later(PartitionIndex p) const
{
  if (this->Total)
  {
    const PartitionIndex* const all = this->Sequence.data();
    return { all + this->position(p) + 1, all + this->Sequence.size() };
  }
  const std::size_t earlier = this->EarlierCounts[std::size_t(p)];
  const std::vector<PartitionIndex>& all = this->Conflicts.neighbours(p);
  return { all.data() + earlier, all.data() + all.size() };
}

PartitionIndex PartitionOrder::first(const PartitionIndex* begin, const PartitionIndex* end) const
{
  return *std::min_element(begin, end,
    [this](PartitionIndex a, PartitionIndex b) { return this->position(a) < this->position(b); });
}

} // namespace tipp
