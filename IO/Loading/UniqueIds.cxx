// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/UniqueIds.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tipp
{

UniqueIds::UniqueIds(const std::int64_t* ids, std::size_t count)
  : Numbers(count)
{
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  if (count > none)
  {
    throw std::length_error("a chunk of 2^32 vertex ids or more is asked for");
  }
  int bits = 4;
  while ((std::size_t(1) << bits) < 2 * count)
  {
    ++bits;
  }
  std::vector<std::uint32_t> table(std::size_t(1) << bits, none); // open addressing
  for (std::size_t i = 0; i < count; ++i)
  {
    constexpr std::uint64_t goldenRatio = 0x9E3779B97F4A7C15;
    std::size_t at = std::size_t((std::uint64_t(ids[i]) * goldenRatio) >> (64 - bits));
    while (table[at] != none && this->Sorted[table[at]].first != ids[i])
    {
      at = (at + 1) & (table.size() - 1);
    }
    if (table[at] == none)
    {
      table[at] = std::uint32_t(this->Sorted.size());
      this->Sorted.emplace_back(ids[i], table[at]);
    }
    this->Numbers[i] = table[at];
  }
  std::sort(this->Sorted.begin(), this->Sorted.end());
}

} // namespace tipp
