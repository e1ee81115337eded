// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/PartitionSchedule.h"

#include "Parallel/Sort.h"
#include "Parallel/Threads.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <tuple>

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
  this->setWindows({});
}

void PartitionOrder::setWindows(const std::vector<std::int32_t>& windows)
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

PartitionOrder::LaterPartitions PartitionOrder::later(PartitionIndex p) const
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

ReadyPartitions::ReadyPartitions(const PartitionOrder& order, Waits waits, std::vector<char> isOwn)
  : Order(order)
  , Condition(waits)
  , Own(std::move(isOwn))
  , Awaited(order.partitionCount())
  , LeftInColour(waits == Waits::ForColour ? order.colourCount() : 0)
  , Ranks(order.partitionCount(), 0)
  , ReadyBits((order.sequence().size() + 63) / 64)
{
  for (const PartitionIndex p : order.byUrgency())
  {
    if (this->isOwn(p))
    {
      this->Ranks[std::size_t(p)] = static_cast<std::uint32_t>(this->Urgency.size());
      this->Urgency.push_back(p);
    }
  }
  this->NotTaken = this->Urgency.size();
  if (waits != Waits::ForColour)
  {
    this->awaitEarlier();
    return;
  }
  for (std::size_t colour = 0; colour < order.colourCount(); ++colour)
  {
    this->LeftInColour[colour] = std::int64_t(order.colourSize(colour));
  }
  if (order.colourCount() > 0)
  {
    this->releaseColour(0);
  }
}

void ReadyPartitions::awaitEarlier()
{
  for (const PartitionIndex p : this->Order.sequence())
  {
    this->Awaited[std::size_t(p)] += this->Condition == Waits::ForEarlier ? 0 : 1;
    if (this->Condition != Waits::ForLoad)
    {
      for (const PartitionIndex later : this->Order.later(p))
      {
        ++this->Awaited[std::size_t(later)];
      }
    }
  }
  for (const PartitionIndex p : this->Order.sequence())
  {
    if (this->Awaited[std::size_t(p)] == 0 && this->isOwn(p))
    {
      this->release(p);
    }
  }
}

/// Releases the partitions of a colour. They are consecutive, since the order has no windows.
void ReadyPartitions::releaseColour(std::size_t colour)
{
  const auto& sequence = this->Order.sequence();
  const auto first = std::partition_point(sequence.begin(), sequence.end(),
    [&](PartitionIndex p) { return this->Order.colourOf(p) < colour; });
  std::for_each(first, first + std::ptrdiff_t(this->Order.colourSize(colour)),
    [this](PartitionIndex p)
    {
      if (this->isOwn(p))
      {
        this->release(p);
      }
    });
}

void ReadyPartitions::release(PartitionIndex p)
{
  const std::uint32_t rank = this->Ranks[std::size_t(p)];
  this->ReadyBits[rank / 64].fetch_or(std::uint64_t(1) << rank % 64, std::memory_order_release);
}

PartitionIndex ReadyPartitions::take()
{
  ThreadPool::updateAffinity();
  for (int turn = 0; !this->isStopped(); ++turn)
  {
    const PartitionIndex p = this->tryTake();
    if (p != NoPartition || this->NotTaken.load(std::memory_order_relaxed) == 0)
    {
      return p;
    }
    // First yields the core to other threads; sleeps if the wait is longer.
    constexpr int yields = 32;
    turn < yields ? std::this_thread::yield()
                  : std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  return NoPartition;
}

PartitionIndex ReadyPartitions::tryTake()
{
  for (std::size_t i = 0; i < this->ReadyBits.size() && !this->isStopped(); ++i)
  {
    std::atomic<std::uint64_t>& bits = this->ReadyBits[i];
    for (std::uint64_t seen = bits.load(std::memory_order_relaxed); seen != 0;)
    {
      const std::uint64_t lowest = seen & (~seen + 1);
      seen = bits.fetch_and(~lowest, std::memory_order_acquire);
      if ((seen & lowest) != 0)
      {
        this->NotTaken.fetch_sub(1, std::memory_order_relaxed);
        return this->Urgency[64 * i + std::size_t(__builtin_ctzll(lowest))];
      }
    }
  }
  return NoPartition;
}

void ReadyPartitions::finish(PartitionIndex p)
{
  if (this->Condition == Waits::ForLoad)
  {
    return;
  }
  if (this->Condition == Waits::ForColour)
  {
    const std::size_t colour = this->Order.colourOf(p);
    const bool isLast = this->LeftInColour[colour].fetch_sub(1, std::memory_order_acq_rel) == 1;
    if (isLast && colour + 1 < this->Order.colourCount())
    {
      this->releaseColour(colour + 1);
    }
    return;
  }
  for (const PartitionIndex q : this->Order.later(p))
  {
    this->countDown(q);
  }
}

void ReadyPartitions::countDown(PartitionIndex p)
{
  if (this->isOwn(p) && this->Awaited[std::size_t(p)].fetch_sub(1, std::memory_order_acq_rel) == 1)
  {
    this->release(p);
  }
}

void ReadyPartitions::stop(const std::exception_ptr& reason)
{
  const std::lock_guard<std::mutex> lock(this->FailureMutex);
  if (reason && !this->Failure)
  {
    this->Failure = reason;
  }
  this->Stopped = true;
}

void runWorkers(ReadyPartitions& ready, int threads, const std::function<void(int thread)>& work)
{
  runOnThreads(threads,
    [&](int thread)
    {
      try
      {
        work(thread);
      }
      catch (...)
      {
        ready.stop(std::current_exception());
      }
    });
  if (ready.failure())
  {
    std::rethrow_exception(ready.failure());
  }
}

} // namespace tipp
