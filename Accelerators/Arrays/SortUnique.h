// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSortUnique_h
#define tippSortUnique_h

#include <algorithm>
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

} // namespace tipp

#endif
