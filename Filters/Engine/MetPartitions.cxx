// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/MetPartitions.h"

#include <algorithm>

namespace tipp
{

std::uint32_t PartitionSets::number(const PartitionIndex* first, const PartitionIndex* last)
{
  const auto isEqual = [&](std::uint32_t set)
  { return std::equal(this->begin(set), this->end(set), first, last); };
  if (this->Last < this->size() && isEqual(this->Last))
  {
    return this->Last;
  }
  std::uint64_t hash = 0;
  for (const PartitionIndex* p = first; p != last; ++p)
  {
    hash = (hash ^ std::uint64_t(*p + 1)) * 0x9e3779b97f4a7c15U;
  }
  const auto [begin, end] = this->ByHash.equal_range(hash);
  const auto known =
    std::find_if(begin, end, [&](const auto& entry) { return isEqual(entry.second); });
  if (known != end)
  {
    this->Last = known->second;
    return this->Last;
  }
  this->Last = static_cast<std::uint32_t>(this->size());
  this->Members.insert(this->Members.end(), first, last);
  this->Ends.push_back(this->Members.size());
  this->ByHash.emplace(hash, this->Last);
  return this->Last;
}

} // namespace tipp
