// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/PartitionOrder.h"

#include "Triangulation/SeamTriangles.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

using Conflict = std::uint64_t;

Conflict conflictOf(PartitionIndex a, PartitionIndex b)
{
  return std::uint64_t(std::uint32_t(a)) << 32 | std::uint32_t(b);
}

/// Adds both (a, b) and (b, a) for all a of one set and b of the other.
void addConflicts(
  const PartitionSets& sets, std::uint32_t one, std::uint32_t other, std::vector<Conflict>& pairs)
{
  for (const PartitionIndex* a = sets.begin(one); a != sets.end(one); ++a)
  {
    for (const PartitionIndex* b = sets.begin(other); b != sets.end(other); ++b)
    {
      if (*a != *b)
      {
        pairs.push_back(conflictOf(*a, *b));
        pairs.push_back(conflictOf(*b, *a));
      }
    }
  }
}

void makeUnique(std::vector<Conflict>& pairs)
{
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

} // namespace

PartitionOrder::PartitionOrder(const std::vector<char>& isUsed, const SeamTriangles& initialMesh,
  const std::vector<std::int32_t>& windows)
  : Positions(isUsed.size(), 0)
  , Colours(isUsed.size(), 0)
{
  for (std::size_t p = 0; p < isUsed.size(); ++p)
  {
    if (isUsed[p])
    {
      this->Sequence.push_back(static_cast<PartitionIndex>(p));
    }
  }
  this->Total = !this->findConflicts(initialMesh);
  this->colour();
  const auto key = [&](PartitionIndex p)
  { return std::make_pair(windows.empty() ? 0 : windows[std::size_t(p)], this->colourOf(p)); };
  std::stable_sort(this->Sequence.begin(), this->Sequence.end(),
    [&](PartitionIndex a, PartitionIndex b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < this->Sequence.size(); ++i)
  {
    this->Positions[std::size_t(this->Sequence[i])] = static_cast<std::uint32_t>(i);
  }
  this->orderConflicts();
}

/// False if there are so many conflicts that a total order costs little: where points lie on a
/// circle, each disk meets nearly all partitions.
bool PartitionOrder::findConflicts(const SeamTriangles& initialMesh)
{
  constexpr std::size_t mostUnsorted = std::size_t(1) << 22;
  constexpr std::size_t mostOfAPartition = 256;
  const std::size_t limit = mostOfAPartition * std::max<std::size_t>(4096, this->Positions.size());
  const PartitionSets& sets = initialMesh.Sets;
  std::vector<Conflict> pairs;
  std::size_t unique = 0;
  const auto add = [&](std::uint32_t one, std::uint32_t other)
  {
    addConflicts(sets, one, other, pairs);
    if (pairs.size() > 2 * unique + mostUnsorted)
    {
      makeUnique(pairs);
      unique = pairs.size();
    }
    return unique <= limit;
  };
  for (std::uint32_t set = 0; set < sets.size(); ++set)
  {
    const std::size_t size = std::size_t(sets.end(set) - sets.begin(set));
    if (size * size > limit || !add(set, set))
    {
      return false;
    }
  }
  for (const auto& [one, other] : initialMesh.AdjacentSets)
  {
    if (!add(one, other))
    {
      return false;
    }
  }
  makeUnique(pairs);
  this->Ends.assign(this->Positions.size(), 0);
  this->Conflicts.reserve(pairs.size());
  for (const Conflict pair : pairs)
  {
    this->Conflicts.push_back(static_cast<PartitionIndex>(pair & 0xffffffffU));
    this->Ends[std::size_t(pair >> 32)] = this->Conflicts.size();
  }
  std::partial_sum(this->Ends.begin(), this->Ends.end(), this->Ends.begin(),
    [](std::size_t before, std::size_t end) { return std::max(before, end); });
  return true;
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
  const auto begin = [this](PartitionIndex p)
  { return p == 0 ? 0 : this->Ends[std::size_t(p) - 1]; };
  std::vector<PartitionIndex> order = this->Sequence;
  std::stable_sort(order.begin(), order.end(),
    [&](PartitionIndex a, PartitionIndex b)
    { return this->Ends[std::size_t(a)] - begin(a) > this->Ends[std::size_t(b)] - begin(b); });
  constexpr std::uint32_t none = ~0U;
  this->Colours.assign(this->Colours.size(), none);
  std::vector<PartitionIndex>
    takenFor; // of each colour, the partition that it was last refused for
  for (const PartitionIndex p : order)
  {
    for (std::size_t i = begin(p); i < this->Ends[std::size_t(p)]; ++i)
    {
      const std::uint32_t taken = this->Colours[std::size_t(this->Conflicts[i])];
      if (taken != none)
      {
        takenFor[taken] = p;
      }
    }
    const auto free = std::find_if(
      takenFor.begin(), takenFor.end(), [p](PartitionIndex taken) { return taken != p; });
    this->Colours[std::size_t(p)] = static_cast<std::uint32_t>(free - takenFor.begin());
    if (free == takenFor.end())
    {
      takenFor.push_back(-1);
    }
  }
  this->ColourSizes.assign(takenFor.size(), 0);
  for (const PartitionIndex p : this->Sequence)
  {
    ++this->ColourSizes[this->colourOf(p)];
  }
}

void PartitionOrder::orderConflicts()
{
  this->LaterBegins.resize(this->Ends.size());
  for (std::size_t p = 0; p < this->Ends.size(); ++p)
  {
    const auto begin = this->Conflicts.begin() + std::ptrdiff_t(p == 0 ? 0 : this->Ends[p - 1]);
    const auto end = this->Conflicts.begin() + std::ptrdiff_t(this->Ends[p]);
    std::sort(begin, end,
      [this](PartitionIndex a, PartitionIndex b) { return this->position(a) < this->position(b); });
    const auto later = std::partition_point(
      begin, end, [this, p](PartitionIndex q) { return this->position(q) < this->Positions[p]; });
    this->LaterBegins[p] = std::size_t(later - this->Conflicts.begin());
  }
}

PartitionOrder::Range PartitionOrder::later(PartitionIndex p) const
{
  if (this->Total)
  {
    const PartitionIndex* const all = this->Sequence.data();
    return { all + this->position(p) + 1, all + this->Sequence.size() };
  }
  const PartitionIndex* const all = this->Conflicts.data();
  return { all + this->LaterBegins[std::size_t(p)], all + this->Ends[std::size_t(p)] };
}

PartitionIndex PartitionOrder::first(const PartitionIndex* begin, const PartitionIndex* end) const
{
  return *std::min_element(begin, end,
    [this](PartitionIndex a, PartitionIndex b) { return this->position(a) < this->position(b); });
}

} // namespace tipp
