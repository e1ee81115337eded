// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBlockCache_h
#define tippBlockCache_h

#include "Loading/ArrayFiles.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace tipp
{

/// An LRU cache's bookkeeping: a hash table from block numbers to slots, and a doubly linked list
/// of the slots, the most recently used first.
class BlockCache
{
public:
  struct Found
  {
    std::uint32_t Slot;
    bool Miss; ///< the slot is assigned to the block, but the caller has yet to fill it
  };

  /// `slots` is in [1, 2^30].
  explicit BlockCache(std::uint32_t slots);

  /// Returns the block's slot and makes it the most recently used one. A block that is not cached
  /// replaces the least recently used one.
  Found use(std::uint64_t block);

  /// Empties the slot; call it if the block of a miss could not be read.
  void forget(std::uint32_t slot);

  /// Prefetches the table entry that use(block) will read first.
  void prefetch(std::uint64_t block) const
  {
    __builtin_prefetch(&this->Table[this->bucketOf(block)]);
  }

private:
  struct Slot
  {
    std::uint64_t Block;
    std::uint32_t Before;
    std::uint32_t After;
  };

  std::size_t bucketOf(std::uint64_t block) const
  {
    return std::size_t(block * 0x9E3779B97F4A7C15U >> this->TableShift);
  }
  void unlink(std::uint32_t slot);
  void linkFirst(std::uint32_t slot);
  void erase(std::uint64_t block);

  static constexpr std::uint64_t nothing = ~std::uint64_t(0);

  std::vector<Slot> Slots; ///< one more than requested: the list's sentinel
  std::vector<std::uint32_t> Table;
  int TableShift;
  std::uint32_t End; ///< the sentinel's slot
};

/// An LRU cache of single tuples, with a fixed number of slots.
class TupleCache
{
public:
  TupleCache(const ArrayFiles& files, std::uint32_t slots)
    : Slots(slots)
  {
    this->Tuples.resize(files, slots);
  }

  /// Returns the tuple's slot. After a miss the caller must fill it; if that fails, the cache must
  /// not be used any more.
  BlockCache::Found use(std::int64_t id) { return this->Slots.use(std::uint64_t(id)); }

  void fill(std::uint32_t slot, const ArrayFiles& files, TupleBuffers& from, std::size_t index)
  {
    for (std::size_t a = 0; a < files.count(); ++a)
    {
      const std::size_t bytes = files.tupleBytes(a);
      std::memcpy(this->Tuples.data(a) + slot * bytes, from.data(a) + index * bytes, bytes);
    }
  }

  TupleBuffers& tuples() { return this->Tuples; }

private:
  BlockCache Slots;
  TupleBuffers Tuples;
};

} // namespace tipp

#endif
