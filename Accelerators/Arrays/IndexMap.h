// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIndexMap_h
#define tippIndexMap_h

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{

/// Numbers keys 0, 1, 2, ... in the order in which they are inserted. It is a hash table with
/// linear probing, meant to be filled and cleared many times: clear() takes constant time.
class IndexMap
{
public:
  static constexpr std::int32_t None = -1;

  struct Inserted
  {
    std::int32_t Index;
    bool IsNew;
  };

  void clear()
  {
    this->Count = 0;
    if (++this->Current == 0)
    {
      this->Slots.assign(this->Slots.size(), Slot{});
      this->Current = 1;
    }
  }

  std::size_t size() const { return std::size_t(this->Count); }

  /// The index of a key, which is inserted if it is not there. Throws std::length_error if there
  /// would be more than 2^31 keys.
  Inserted insert(std::int64_t key)
  {
    if (2 * this->size() >= this->Slots.size())
    {
      this->enlarge();
    }
    Slot& slot = this->Slots[this->locate(key)];
    const bool isNew = slot.Map != this->Current;
    if (isNew)
    {
      slot = { key, this->Current, this->Count++ };
    }
    return { slot.Index, isNew };
  }

  /// The index of a key, or None.
  std::int32_t find(std::int64_t key) const
  {
    const Slot& slot = this->Slots[this->locate(key)];
    return slot.Map == this->Current ? slot.Index : None;
  }

private:
  struct Slot
  {
    std::int64_t Key = 0;
    std::uint32_t Map = 0; ///< the slot is free if this is not Current
    std::int32_t Index = 0;
  };

  /// The key's slot, or the free one where it belongs.
  std::size_t locate(std::int64_t key) const
  {
    const std::size_t mask = this->Slots.size() - 1;
    constexpr std::uint64_t multiplier = 0x9E3779B97F4A7C15; // 2^64 over the golden ratio
    std::size_t at = std::size_t((std::uint64_t(key) * multiplier) >> 32) & mask;
    while (this->Slots[at].Map == this->Current && this->Slots[at].Key != key)
    {
      at = (at + 1) & mask;
    }
    return at;
  }

  void enlarge()
  {
    constexpr std::size_t most = std::size_t(1) << 32; // half of the slots are free
    if (this->Slots.size() >= most)
    {
      throw std::length_error("more than 2^31 different ids are to be numbered");
    }
    const std::vector<Slot> old =
      std::exchange(this->Slots, std::vector<Slot>(2 * this->Slots.size()));
    for (const Slot& slot : old)
    {
      if (slot.Map == this->Current)
      {
        this->Slots[this->locate(slot.Key)] = slot;
      }
    }
  }

  std::uint32_t Current = 1;
  std::int32_t Count = 0;
  std::vector<Slot> Slots = std::vector<Slot>(64); ///< a power of two
};

} // namespace tipp

#endif
