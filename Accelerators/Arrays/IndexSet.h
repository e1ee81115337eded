// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIndexSet_h
#define tippIndexSet_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A set of indices below a size, one bit each, which numbers its elements in ascending order.
class IndexSet
{
public:
  explicit IndexSet(std::int64_t size)
    : Words(std::size_t(size / Bits + 1))
  {
  }

  void add(std::int64_t index) { this->Words[wordOf(index)] |= bitOf(index); }

  /// Must be called when all elements have been added, and before the functions below.
  void number()
  {
    this->Ranks.resize(this->Words.size() + 1);
    for (std::size_t i = 0; i < this->Words.size(); ++i)
    {
      this->Ranks[i + 1] = this->Ranks[i] + __builtin_popcountll(this->Words[i]);
    }
  }

  std::int64_t count() const { return this->Ranks.back(); }
  bool contains(std::int64_t index) const
  {
    return (this->Words[wordOf(index)] & bitOf(index)) != 0;
  }
  /// The number of elements below an index: the number of the element with this index.
  std::int64_t rank(std::int64_t index) const
  {
    const std::size_t word = wordOf(index);
    return this->Ranks[word] + __builtin_popcountll(this->Words[word] & (bitOf(index) - 1));
  }

  /// The elements, ascending.
  std::vector<std::int32_t> elements() const
  {
    std::vector<std::int32_t> elements;
    elements.reserve(std::size_t(this->count()));
    for (std::size_t i = 0; i < this->Words.size(); ++i)
    {
      for (std::uint64_t left = this->Words[i]; left != 0; left &= left - 1)
      {
        elements.push_back(std::int32_t(std::int64_t(i) * Bits + __builtin_ctzll(left)));
      }
    }
    return elements;
  }

private:
  static constexpr std::int64_t Bits = 64;

  static std::size_t wordOf(std::int64_t index) { return std::size_t(index / Bits); }
  static std::uint64_t bitOf(std::int64_t index) { return std::uint64_t(1) << (index % Bits); }

  std::vector<std::uint64_t> Words;
  std::vector<std::int64_t> Ranks; ///< the number of elements before each word
};

} // namespace tipp

#endif
