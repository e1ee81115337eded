// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSort_h
#define tippSort_h

#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Sorts the items and removes repeated ones.
template <typename Item>
void sortUnique(std::vector<Item>& items)
{
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// The items, sorted and without repetition.
template <typename Item>
std::vector<Item> sortedUnique(std::vector<Item> items)
{
  sortUnique(items);
  return items;
}

/// Sorts [begin, end): each thread sorts a part, then neighbouring parts are merged.
template <typename Iterator>
void sortInParts(Iterator begin, Iterator end, int threads)
{
  const auto border = [&](std::int64_t part) { return begin + (end - begin) * part / threads; };
  forChunks(threads, 1, threads, {},
    [&](std::int64_t part, std::int64_t, int) { std::sort(border(part), border(part + 1)); });
  for (std::int64_t part = 1; part < threads; ++part)
  {
    std::inplace_merge(begin, border(part), border(part + 1));
  }
}

/// Sorts words by their bits `lowest` to 63, by default the upper half, on at most `threads`
/// threads (at least 1). The sort is stable.
inline void sortByUpperHalf(std::vector<std::uint64_t>& words, int threads, unsigned lowest = 32)
{
  constexpr unsigned digitBits = 11;
  constexpr std::size_t digits = std::size_t(1) << digitBits;
  constexpr std::size_t shortest = 16384; // the smallest share worth a thread
  const auto shares =
    std::int64_t(std::max<std::size_t>(1, std::min(std::size_t(threads), words.size() / shortest)));
  std::vector<std::uint64_t> sorted(words.size());
  std::vector<std::array<std::size_t, digits>> next(static_cast<std::size_t>(shares));
  const auto forShare = [&](std::int64_t share, const auto& visit)
  {
    const std::size_t end = words.size() * std::size_t(share + 1) / std::size_t(shares);
    for (std::size_t i = words.size() * std::size_t(share) / std::size_t(shares); i < end; ++i)
    {
      visit(words[i]);
    }
  };
  for (unsigned shift = lowest; shift < 64; shift += digitBits)
  {
    const auto digitOf = [shift](std::uint64_t word)
    { return std::size_t(word >> shift) & (digits - 1); };
    parallelFor(shares, threads,
      [&](std::int64_t share)
      {
        auto& counts = next[std::size_t(share)];
        counts.fill(0);
        forShare(share, [&](std::uint64_t word) { ++counts[digitOf(word)]; });
      });
    countsToIndices(digits, next);
    parallelFor(shares, threads,
      [&](std::int64_t share)
      {
        auto& positions = next[std::size_t(share)];
        forShare(share, [&](std::uint64_t word) { sorted[positions[digitOf(word)]++] = word; });
      });
    words.swap(sorted);
  }
}

} // namespace tipp

#endif
