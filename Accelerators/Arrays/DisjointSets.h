// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDisjointSets_h
#define tippDisjointSets_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

// Disjoint sets of items (union-find): parents[i] is an item of the same set as item i, and not
// higher. The lowest item of a set, its root, is its own parent.

/// Returns the root of an item's set. Halves the path to it.
inline std::int64_t rootIn(std::vector<std::int64_t>& parents, std::int64_t item)
{
  for (auto at = std::size_t(item); parents[at] != item; at = std::size_t(item))
  {
    item = parents[at] = parents[std::size_t(parents[at])];
  }
  return item;
}

/// Joins the sets of two items.
inline void joinIn(std::vector<std::int64_t>& parents, std::int64_t a, std::int64_t b)
{
  const auto [low, high] = std::minmax({ rootIn(parents, a), rootIn(parents, b) });
  parents[std::size_t(high)] = low;
}

} // namespace tipp

#endif
