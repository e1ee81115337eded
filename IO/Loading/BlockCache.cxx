// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/BlockCache.h"

#include "Arrays/IndexMap.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>

namespace tipp
{
namespace
{

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

void append(std::vector<TupleRun>& runs, const TupleRun& run, std::int64_t gap)
{
  if (!runs.empty() &&
    run.First - (runs.back().First + runs.back().Size) < std::max<std::int64_t>(gap, 1))
  {
    runs.back().Size = run.First + run.Size - runs.back().First;
  }
  else
  {
    runs.push_back(run);
  }
}

} // namespace

UniqueIds::UniqueIds(const std::int64_t* ids, std::size_t count)
  : Numbers(count)
{
  IndexMap numbers;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto [number, isNew] = numbers.insert(ids[i]);
    this->Numbers[i] = std::uint32_t(number);
    if (isNew)
    {
      this->Sorted.emplace_back(ids[i], this->Numbers[i]);
    }
  }
  std::sort(this->Sorted.begin(), this->Sorted.end());
}

std::vector<char> findActive(const std::int64_t* ids, std::size_t count, std::int64_t low,
  std::size_t blocks, int shift, int threads)
{
  constexpr std::size_t least = 1 << 18;
  // Each thread has a bitmap of its own, so the number of threads bounds the number of bitmaps.
  const std::size_t shares =
    std::max<std::size_t>(std::min(std::size_t(threadCount(threads)), count / least), 1);
  std::vector<std::vector<char>> parts(shares);
  parallelFor(std::int64_t(shares), threads,
    [&](std::int64_t part)
    {
      std::vector<char> own(blocks, 0);
      char* const active = own.data(); // a local, since writing a char may alias a member
      const std::size_t end = count * (std::size_t(part) + 1) / shares;
      for (std::size_t i = count * std::size_t(part) / shares; i < end; ++i)
      {
        active[std::uint64_t(ids[i] - low) >> shift] = 1;
      }
      parts[std::size_t(part)] = std::move(own);
    });
  for (std::size_t part = 1; part < shares; ++part)
  {
    std::transform(parts[part].begin(), parts[part].end(), parts[0].begin(), parts[0].begin(),
      [](char a, char b) { return char(a | b); });
  }
  return std::move(parts[0]);
}

std::vector<TupleRun> runsOfBlocks(const std::vector<char>& active, std::int64_t block,
  std::int64_t low, std::int64_t high, std::int64_t gap)
{
  std::vector<TupleRun> runs;
  for (std::size_t i = 0; i < active.size(); ++i)
  {
    if (active[i] != 0)
    {
      const std::int64_t first = low + std::int64_t(i) * block;
      append(runs, { first, std::min(block, high + 1 - first) }, gap);
    }
  }
  return runs;
}

std::vector<TupleRun> runsOfIds(
  const std::vector<std::pair<std::int64_t, std::uint32_t>>& ids, std::int64_t gap)
{
  std::vector<TupleRun> runs;
  for (const auto& pair : ids)
  {
    if (runs.empty() || pair.first >= runs.back().First + runs.back().Size)
    {
      append(runs, { pair.first, 1 }, gap);
    }
  }
  return runs;
}

RunPlan::RunPlan(
  const std::vector<TupleRun>& runs, std::int64_t m, std::int64_t block, std::int64_t low)
  : Starts{ 0 }
{
  std::int64_t room = m;
  const auto add = [&](const TupleRun& run)
  {
    this->Packed.push_back(std::uint32_t(m - room));
    this->GroupOf.push_back(std::uint32_t(this->Starts.size() - 1));
    this->Runs.push_back(run);
    room -= run.Size;
  };
  for (TupleRun run : runs)
  {
    while (run.Size > room)
    {
      // A whole number of blocks, so that no tiny run remains.
      const std::int64_t end = run.First + room - (run.First + room - low) % block;
      const std::int64_t size = end - run.First;
      if (size > 0)
      {
        add({ run.First, size });
        run = { end, run.Size - size };
      }
      if (this->Runs.size() > this->Starts.back())
      {
        this->Starts.push_back(this->Runs.size());
      }
      room = m;
    }
    add(run);
  }
  this->Starts.push_back(this->Runs.size());
}

void HeldBlocks::forget()
{
  std::fill(this->Positions.begin(), this->Positions.end(), nowhere);
  this->Used = 0;
}

std::vector<char> HeldBlocks::missing(const std::vector<char>& active, std::int64_t low)
{
  this->Positions.resize(std::size_t((this->Tuples - 1) >> this->Shift) + 1, nowhere);
  std::vector<char> missing = active;
  const std::uint32_t* const positions = this->Positions.data() + (low >> this->Shift);
  for (std::size_t block = 0; block < missing.size(); ++block)
  {
    missing[block] &= char(positions[block] == nowhere);
  }
  return missing;
}

void HeldBlocks::add(const TupleRun& run)
{
  for (std::int64_t at = 0; at < run.Size; at += std::int64_t(1) << this->Shift)
  {
    this->Positions[std::size_t((run.First + at) >> this->Shift)] = std::uint32_t(this->Used + at);
  }
  this->Used += run.Size;
}

bool HeldBlocks::find(const std::int64_t* ids, std::size_t count, std::uint32_t* positions)
{
  constexpr std::size_t ahead = 512; // the hardware prefetcher stops at page boundaries
  const std::int64_t most = std::min(std::int64_t(count), this->Room - this->Used);
  const auto tuples = std::uint64_t(this->Tuples);
  const int shift = this->Shift; // a local, since writing positions may alias a member
  const std::uint64_t inBlock = this->mask();
  const std::uint32_t* const blocks = this->Positions.data();
  this->Found.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    __builtin_prefetch(ids + i + ahead);
    const auto id = std::uint64_t(ids[i]);
    if (id >= tuples || (blocks[id >> shift] == nowhere && !this->addFound(id >> shift, most)))
    {
      this->loseFound();
      return false;
    }
    positions[i] = blocks[id >> shift] + std::uint32_t(id & inBlock);
  }
  return true;
}

/// Rarely called; inlining it makes find() slower.
[[gnu::noinline]] bool HeldBlocks::addFound(std::uint64_t block, std::int64_t most)
{
  const std::int64_t before = std::int64_t(this->Found.size()) << this->Shift;
  if (before + (std::int64_t(1) << this->Shift) > most)
  {
    return false;
  }
  this->Positions[block] = std::uint32_t(this->Used + before);
  this->Found.push_back(block);
  return true;
}

std::vector<TupleRun> HeldBlocks::found() const
{
  std::vector<TupleRun> runs;
  for (const std::uint64_t block : this->Found)
  {
    const std::int64_t first = std::int64_t(block) << this->Shift;
    const std::int64_t size = std::min(std::int64_t(1) << this->Shift, this->Tuples - first);
    if (!runs.empty() && runs.back().First + runs.back().Size == first)
    {
      runs.back().Size += size;
    }
    else
    {
      runs.push_back({ first, size });
    }
  }
  return runs;
}

void HeldBlocks::keepFound()
{
  this->Used += std::int64_t(this->Found.size()) << this->Shift;
  this->Found.clear();
}

void HeldBlocks::loseFound()
{
  for (const std::uint64_t block : this->Found)
  {
    this->Positions[block] = nowhere;
  }
  this->Found.clear();
}

BlockCache::BlockCache(std::uint32_t slots)
  : Slots(std::size_t(slots) + 1)
  , End(slots)
{
  int bits = 1;
  while ((std::size_t(1) << bits) < 2 * std::size_t(slots)) // at most half full
  {
    ++bits;
  }
  this->Table.assign(std::size_t(1) << bits, none);
  this->TableShift = 64 - bits;
  this->Slots[this->End] = { nothing, this->End, this->End };
  for (std::uint32_t slot = 0; slot < slots; ++slot)
  {
    this->Slots[slot].Block = nothing;
    this->linkFirst(slot);
  }
}

void BlockCache::unlink(std::uint32_t slot)
{
  const Slot& old = this->Slots[slot];
  this->Slots[old.Before].After = old.After;
  this->Slots[old.After].Before = old.Before;
}

void BlockCache::linkFirst(std::uint32_t slot)
{
  const std::uint32_t first = this->Slots[this->End].After;
  this->Slots[slot].Before = this->End;
  this->Slots[slot].After = first;
  this->Slots[first].Before = slot;
  this->Slots[this->End].After = slot;
}

BlockCache::UsedSlot BlockCache::use(std::uint64_t block)
{
  const std::size_t mask = this->Table.size() - 1;
  std::size_t at = this->bucketOf(block);
  for (; this->Table[at] != none; at = (at + 1) & mask)
  {
    const std::uint32_t slot = this->Table[at];
    if (this->Slots[slot].Block == block)
    {
      if (this->Slots[this->End].After != slot)
      {
        this->unlink(slot);
        this->linkFirst(slot);
      }
      return { slot, false };
    }
  }
  const std::uint32_t slot = this->Slots[this->End].Before;
  if (this->Slots[slot].Block != nothing)
  {
    this->erase(this->Slots[slot].Block);
    // Erasing may have moved the entry that was found.
    for (at = this->bucketOf(block); this->Table[at] != none; at = (at + 1) & mask)
    {
    }
  }
  this->Table[at] = slot;
  this->Slots[slot].Block = block;
  this->unlink(slot);
  this->linkFirst(slot);
  return { slot, true };
}

// Knuth's algorithm 6.4 R: later entries move into the gap unless that precedes their hash
// position.
void BlockCache::erase(std::uint64_t block)
{
  const std::size_t mask = this->Table.size() - 1;
  std::size_t gap = this->bucketOf(block);
  while (this->Slots[this->Table[gap]].Block != block)
  {
    gap = (gap + 1) & mask;
  }
  for (std::size_t at = (gap + 1) & mask; this->Table[at] != none; at = (at + 1) & mask)
  {
    const std::size_t bucket = this->bucketOf(this->Slots[this->Table[at]].Block);
    if (((at - bucket) & mask) >= ((at - gap) & mask))
    {
      this->Table[gap] = this->Table[at];
      gap = at;
    }
  }
  this->Table[gap] = none;
}

} // namespace tipp
