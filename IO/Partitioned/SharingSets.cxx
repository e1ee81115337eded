// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/SharingSets.h"

#include <algorithm>
#include <iterator>

namespace tipp
{

int SharingSets::number(const std::vector<std::int32_t>& set)
{
  const auto [found, isNew] = this->Numbers.emplace(set, int(this->Sets.size()));
  if (isNew)
  {
    this->Sets.push_back(&found->first);
  }
  return found->second;
}

int SharingSets::unite(int a, int b)
{
  if (a == b || a < 0 || b < 0)
  {
    return std::max(a, b);
  }
  const auto [found, isNew] = this->Unions.emplace(std::minmax(a, b), -1);
  if (isNew)
  {
    std::vector<std::int32_t> both;
    std::set_union(this->set(a).begin(), this->set(a).end(), this->set(b).begin(),
      this->set(b).end(), std::back_inserter(both));
    found->second = this->number(both);
  }
  return found->second;
}

std::vector<int> SharingSets::sortedIndices() const
{
  std::vector<int> indices(this->Sets.size());
  int index = 0;
  for (const auto& [set, number] : this->Numbers)
  {
    indices[std::size_t(number)] = index++;
  }
  return indices;
}

SharingSets::Grouping SharingSets::groups(const std::vector<int>& setOf) const
{
  std::vector<std::int64_t> counts(this->Sets.size(), 0);
  for (const int set : setOf)
  {
    if (set >= 0)
    {
      ++counts[std::size_t(set)];
    }
  }
  Grouping grouping;
  grouping.IndexOf.assign(this->Sets.size(), -1);
  for (const auto& [set, number] : this->Numbers)
  {
    const std::int64_t count = counts[std::size_t(number)];
    if (count > 0)
    {
      grouping.IndexOf[std::size_t(number)] = int(grouping.Groups.size());
      grouping.Groups.push_back({ set, count });
    }
  }
  return grouping;
}

} // namespace tipp
