// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/BlockCache.h"

#include <limits>

namespace tipp
{
namespace
{

constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();

} // namespace

BlockCache::BlockCache(std::uint32_t slots)
  : Slots(std::size_t(slots) + 1)
  , End(slots)
{
  // At most half full, so that probe sequences are short.
  int bits = 1;
  while ((std::size_t(1) << bits) < 2 * std::size_t(slots))
  {
    ++bits;
  }
  this->Table.assign(std::size_t(1) << bits, empty);
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

BlockCache::Found BlockCache::use(std::uint64_t block)
{
  const std::size_t mask = this->Table.size() - 1;
  std::size_t at = this->bucketOf(block);
  for (; this->Table[at] != empty; at = (at + 1) & mask)
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
    for (at = this->bucketOf(block); this->Table[at] != empty; at = (at + 1) & mask)
    {
    }
  }
  this->Table[at] = slot;
  this->Slots[slot].Block = block;
  this->unlink(slot);
  this->linkFirst(slot);
  return { slot, true };
}

void BlockCache::forget(std::uint32_t slot)
{
  this->erase(this->Slots[slot].Block);
  this->Slots[slot].Block = nothing;
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
  for (std::size_t at = (gap + 1) & mask; this->Table[at] != empty; at = (at + 1) & mask)
  {
    const std::size_t bucket = this->bucketOf(this->Slots[this->Table[at]].Block);
    if (((at - bucket) & mask) >= ((at - gap) & mask))
    {
      this->Table[gap] = this->Table[at];
      gap = at;
    }
  }
  this->Table[gap] = empty;
}

} // namespace tipp
