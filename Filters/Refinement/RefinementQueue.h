// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRefinementQueue_h
#define tippRefinementQueue_h

#include "Refinement/RefinementRules.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tipp
{

/// The triangles of a block that need a point, the most urgent first: encroached subsegments, thin
/// triangles, large ones, each in buckets by rank, first come, first served within a bucket.
class RefinementQueue
{
public:
  /// A triangle that existed when this was made; see RefinementMesh::isLive().
  struct Element
  {
    std::int32_t Triangle;
    std::uint32_t Version;
  };

  RefinementQueue() { this->First.fill(None), this->Last.fill(None); }

  void add(const Element& element, const RefinementRules::Verdict& verdict)
  {
    const std::size_t bucket = bucketOf(verdict);
    std::uint32_t place = this->Unused;
    if (place != None)
    {
      this->Unused = this->Items[place].Next;
    }
    else
    {
      place = std::uint32_t(this->Items.size());
      this->Items.emplace_back();
    }
    this->Items[place] = { element, None };
    if (this->First[bucket] == None)
    {
      this->First[bucket] = place;
      this->Filled[bucket / 64] |= std::uint64_t(1) << bucket % 64;
    }
    else
    {
      this->Items[this->Last[bucket]].Next = place;
    }
    this->Last[bucket] = place;
    this->LowestWord = std::min(this->LowestWord, bucket / 64);
  }

  /// The element that take() will return next if none is added before it; null if unknown.
  const Element* next() const
  {
    return this->After != None ? &this->Items[this->After].What : nullptr;
  }

  /// Takes the first one and what it needs; returns false if the queue is empty.
  bool take(Element& element, RefinementRules::Need& need)
  {
    while (this->LowestWord < Words && this->Filled[this->LowestWord] == 0)
    {
      ++this->LowestWord;
    }
    if (this->LowestWord == Words)
    {
      return false;
    }
    const std::size_t bucket =
      64 * this->LowestWord + std::size_t(__builtin_ctzll(this->Filled[this->LowestWord]));
    const std::uint32_t place = this->First[bucket];
    Item& item = this->Items[place];
    element = item.What;
    need = bucket < OfOneNeed  ? RefinementRules::Need::Segment
      : bucket < 2 * OfOneNeed ? RefinementRules::Need::Thin
                               : RefinementRules::Need::Large;
    this->First[bucket] = item.Next;
    this->After = item.Next;
    if (item.Next == None)
    {
      this->Filled[bucket / 64] &= ~(std::uint64_t(1) << bucket % 64);
    }
    item.Next = this->Unused;
    this->Unused = place;
    return true;
  }

  void clear()
  {
    RefinementRules::Need need;
    for (Element element; this->take(element, need);)
    {
    }
  }

private:
  static constexpr std::uint32_t None = 0xffffffff;
  static constexpr std::size_t OfOneNeed = 2048;
  static constexpr std::size_t Words = 3 * OfOneNeed / 64;

  struct Item
  {
    Element What;
    std::uint32_t Next;
  };

  static std::size_t bucketOf(const RefinementRules::Verdict& verdict)
  {
    if (verdict.Why == RefinementRules::Need::Segment)
    {
      return 0;
    }
    // Eight buckets for a factor of two: the exponent and three digits of the mantissa.
    constexpr std::int64_t ofOne = std::int64_t(1023) << 3;
    std::uint64_t bits;
    std::memcpy(&bits, &verdict.Rank, sizeof(bits));
    const std::int64_t step = std::int64_t(bits >> 49) - ofOne + std::int64_t(OfOneNeed / 2);
    const std::size_t need = verdict.Why == RefinementRules::Need::Thin ? 1 : 2;
    return need * OfOneNeed +
      std::size_t(std::clamp<std::int64_t>(step, 0, std::int64_t(OfOneNeed) - 1));
  }

  std::vector<Item> Items;
  std::uint32_t Unused = None;
  std::uint32_t After = None; ///< follows the last one taken in its bucket
  std::array<std::uint32_t, 3 * OfOneNeed> First;
  std::array<std::uint32_t, 3 * OfOneNeed> Last;
  std::array<std::uint64_t, Words> Filled{};
  std::size_t LowestWord = Words;
};

} // namespace tipp

#endif
