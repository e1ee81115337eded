// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBlockCache_h
#define tippBlockCache_h

#include <cstdint>
#include <vector>

namespace tipp
{

/// Which of many blocks are held in a few slots: a hash table from blocks to slots, and a doubly
/// linked list of the slots, the most recently used one first.
class BlockCache
{
public:
  struct Place
  {
    std::uint32_t Slot;
    bool Miss; ///< the slot is the block's from now on, but does not hold it yet
  };

  /// 1 to 2^30 slots.
  explicit BlockCache(std::uint32_t slots);

  /// The block's slot, which becomes the most recently used one. A block that is not held takes the
  /// place of the one that was used least recently.
  Place use(std::uint64_t block);

  /// After a miss whose block could not be read: the slot holds nothing.
  void forget(std::uint32_t slot);

  /// Fetches into the processor's cache what use(block) will look at first.
  void prefetch(std::uint64_t block) const { __builtin_prefetch(&this->Table[this->home(block)]); }

private:
  struct Slot
  {
    std::uint64_t Block;
    std::uint32_t Before;
    std::uint32_t After;
  };

  std::size_t home(std::uint64_t block) const
  {
    return std::size_t(block * 0x9E3779B97F4A7C15U >> this->TableShift);
  }
  void unlink(std::uint32_t slot);
  void linkFirst(std::uint32_t slot);
  void erase(std::uint64_t block);

  static constexpr std::uint64_t nothing = ~std::uint64_t(0);

  std::vector<Slot> Slots; ///< one more than asked for: the list's two ends
  std::vector<std::uint32_t> Table;
  int TableShift;
  std::uint32_t End; ///< the slot that is both ends
};

} // namespace tipp

#endif
