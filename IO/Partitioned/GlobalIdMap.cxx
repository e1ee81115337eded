// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/GlobalIdMap.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace tipp
{

GlobalIdMap::GlobalIdMap(const std::int64_t* ids, const std::int64_t* values, std::size_t count)
{
  if (count == 0)
  {
    return;
  }
  constexpr std::uint64_t limit = std::numeric_limits<std::uint32_t>::max();
  if (count > limit)
  {
    throw std::length_error("a piece has more than 2^32 points; cut the mesh into more pieces");
  }
  this->Least = ids[0];
  this->Range = std::uint64_t(ids[count - 1] - ids[0]);
  while ((this->Range >> this->Shift) >= 2 * count)
  {
    ++this->Shift;
  }
  std::uint64_t greatest = count;
  for (std::size_t i = 0; values && i < count; ++i)
  {
    greatest = std::max(greatest, std::uint64_t(values[i]));
  }
  if (this->Range <= limit && greatest <= limit)
  {
    this->fill(this->Narrow, ids, values, count);
  }
  else
  {
    this->fill(this->Wide, ids, values, count);
  }
}

template <typename Number>
void GlobalIdMap::fill(std::vector<Entry<Number>>& entries, const std::int64_t* ids,
  const std::int64_t* values, std::size_t count)
{
  entries.resize(count);
  this->Starts.assign(std::size_t(this->Range >> this->Shift) + 2, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint64_t key = std::uint64_t(ids[i] - this->Least);
    entries[i] = { Number(key), Number(values ? std::uint64_t(values[i]) : i) };
    ++this->Starts[std::size_t(key >> this->Shift) + 1];
  }
  for (std::size_t i = 1; i < this->Starts.size(); ++i)
  {
    this->Starts[i] += this->Starts[i - 1];
  }
}

template <typename Number>
std::int64_t GlobalIdMap::search(const std::vector<Entry<Number>>& entries, std::uint64_t key) const
{
  if (key > this->Range || entries.empty())
  {
    return -1;
  }
  const std::size_t slot = std::size_t(key >> this->Shift);
  std::uint32_t from = this->Starts[slot];
  std::uint32_t to = this->Starts[slot + 1];
  // If ids are dense in one part of the range and sparse in another, many may share an entry.
  while (to - from > 8)
  {
    const std::uint32_t middle = from + (to - from) / 2;
    (entries[middle].Id <= key ? from : to) = middle;
  }
  for (; from < to; ++from)
  {
    if (entries[from].Id == key)
    {
      return std::int64_t(entries[from].Value);
    }
  }
  return -1;
}

std::int64_t GlobalIdMap::find(std::int64_t id) const
{
  const std::uint64_t key = std::uint64_t(id) - std::uint64_t(this->Least);
  return this->Wide.empty() ? this->search(this->Narrow, key) : this->search(this->Wide, key);
}

template <typename Value>
bool GlobalIdMap::translateAll(const std::int64_t* ids, std::size_t count, Value* values) const
{
  std::int64_t all = 0;
  const auto run = [&](const auto& entries)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint64_t key = std::uint64_t(ids[i]) - std::uint64_t(this->Least);
      const std::int64_t value = this->search(entries, key);
      all |= value;
      values[i] = Value(value);
    }
  };
  if (this->Wide.empty())
  {
    run(this->Narrow);
  }
  else
  {
    run(this->Wide);
  }
  return all >= 0;
}

bool GlobalIdMap::translate(const std::int64_t* ids, std::size_t count, std::int32_t* values) const
{
  return this->translateAll(ids, count, values);
}

bool GlobalIdMap::translate(const std::int64_t* ids, std::size_t count, std::int64_t* values) const
{
  return this->translateAll(ids, count, values);
}

} // namespace tipp
