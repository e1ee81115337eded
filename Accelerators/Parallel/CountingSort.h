// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCountingSort_h
#define tippCountingSort_h

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// Computes the offsets for a stable counting sort on several threads. Each thread has a share of
/// the items, counts how many of them belong to each group, and after this call copies them to
/// their sorted positions. On entry `counts[share][group]` is a number of items; on return it is
/// the index in the sorted array of the share's first item in that group. Returns the index of each
/// group's first item, followed by the total number of items.
template <typename Counts>
std::vector<typename Counts::value_type> countsToIndices(
  std::size_t groups, std::vector<Counts>& counts)
{
  std::vector<typename Counts::value_type> starts;
  starts.reserve(groups + 1);
  typename Counts::value_type sum = 0;
  for (std::size_t group = 0; group < groups; ++group)
  {
    starts.push_back(sum);
    for (Counts& ofShare : counts)
    {
      sum += std::exchange(ofShare[group], sum);
    }
  }
  starts.push_back(sum);
  return starts;
}

/// Items sorted by group, by a counting sort. `Index` must be able to hold the number of items.
template <typename Item, typename Index = std::size_t>
class GroupedItems
{
public:
  GroupedItems() = default;

  /// `forItems(visit)` calls visit(group, item) for every item. It is called twice, and must visit
  /// the same items both times. With one thread the sort is stable. With several, forItems() may
  /// call visit() from all of them, and the order within a group is arbitrary.
  template <typename ForItems>
  GroupedItems(std::size_t groups, int threads, const ForItems& forItems)
    : Groups(groups)
    , Starts(new std::atomic<Index>[groups + 2]())
  {
    const bool isAlone = threads == 1;
    forItems([&](std::size_t group, const Item&) { addOne(this->Starts[group + 2], isAlone); });
    for (std::size_t group = 0; group < groups; ++group)
    {
      this->Starts[group + 2].store(
        this->start(group + 1) + this->start(group + 2), std::memory_order_relaxed);
    }
    this->Items = std::unique_ptr<Item[]>(new Item[this->start(groups + 1)]);
    // Entry group + 1, the start of the group, advances to the group's end.
    forItems([&](std::size_t group, const Item& item)
      { this->Items[addOne(this->Starts[group + 1], isAlone)] = item; });
  }

  std::size_t groups() const { return this->Groups; }
  std::size_t size() const { return this->Starts ? std::size_t(this->start(this->Groups)) : 0; }

  /// The index of a group's first item. For groups(), the number of items.
  Index start(std::size_t group) const
  {
    return this->Starts[group].load(std::memory_order_relaxed);
  }

  ///@{
  /// All items, group by group.
  Item* data() { return this->Items.get(); }
  const Item* data() const { return this->Items.get(); }
  const Item& operator[](std::size_t i) const { return this->Items[i]; }
  ///@}

  ///@{
  /// The items of a group. The end of a group is the beginning of the next.
  Item* begin(std::size_t group) { return this->data() + this->start(group); }
  const Item* begin(std::size_t group) const { return this->data() + this->start(group); }
  Item* end(std::size_t group) { return this->begin(group + 1); }
  const Item* end(std::size_t group) const { return this->begin(group + 1); }
  ///@}

  /// The address of start(group), to prefetch it.
  const void* startAddress(std::size_t group) const { return &this->Starts[group]; }

private:
  /// Increments a counter and returns its previous value. A single thread avoids the locked
  /// instruction.
  static Index addOne(std::atomic<Index>& counter, bool isAlone)
  {
    if (!isAlone)
    {
      return counter.fetch_add(1, std::memory_order_relaxed);
    }
    const Index before = counter.load(std::memory_order_relaxed);
    counter.store(before + 1, std::memory_order_relaxed);
    return before;
  }

  std::size_t Groups = 0;
  std::unique_ptr<std::atomic<Index>[]> Starts; ///< by group; one more than groups() is unused
  std::unique_ptr<Item[]> Items;
};

} // namespace tipp

#endif
