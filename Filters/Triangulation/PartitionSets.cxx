// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PartitionSets.h"

#include <algorithm>

namespace tipp
{
namespace
{

constexpr std::uint32_t Empty = ~0U;

std::uint64_t hashOf(const PartitionIndex* first, const PartitionIndex* last)
{
  std::uint64_t hash = 0;
  for (const PartitionIndex* p = first; p != last; ++p)
  {
    hash = (hash ^ std::uint64_t(*p + 1)) * 0x9e3779b97f4a7c15U;
  }
  return hash >> 32;
}

} // namespace

void PartitionSets::clear()
{
  this->Members.clear();
  this->Ends.clear();
  this->Table.clear();
  this->Last = 0;
}

bool PartitionSets::isEqual(
  std::uint32_t set, const PartitionIndex* first, const PartitionIndex* last) const
{
  return std::equal(this->begin(set), this->end(set), first, last);
}

/// The list's slot in the hash table, or the slot where to insert it.
std::uint32_t& PartitionSets::slot(const PartitionIndex* first, const PartitionIndex* last)
{
  std::size_t at = hashOf(first, last) & (this->Table.size() - 1);
  while (this->Table[at] != Empty && !this->isEqual(this->Table[at], first, last))
  {
    at = (at + 1) & (this->Table.size() - 1);
  }
  return this->Table[at];
}

void PartitionSets::enlargeTable()
{
  this->Table.assign(std::max<std::size_t>(64, 2 * this->Table.size()), Empty);
  for (std::uint32_t set = 0; set < this->size(); ++set)
  {
    this->slot(this->begin(set), this->end(set)) = set;
  }
}

std::uint32_t PartitionSets::number(const PartitionIndex* first, const PartitionIndex* last)
{
  if (this->Last < this->size() && this->isEqual(this->Last, first, last))
  {
    return this->Last;
  }
  if (2 * (this->size() + 1) > this->Table.size())
  {
    this->enlargeTable();
  }
  std::uint32_t& number = this->slot(first, last);
  if (number == Empty)
  {
    number = std::uint32_t(this->size());
    this->Members.insert(this->Members.end(), first, last);
    this->Ends.push_back(this->Members.size());
  }
  this->Last = number;
  return number;
}

} // namespace tipp
