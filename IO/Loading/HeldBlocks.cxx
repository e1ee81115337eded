// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/HeldBlocks.h"

#include <algorithm>

namespace tipp
{

void HeldBlocks::forget()
{
  std::fill(this->Positions.begin(), this->Positions.end(), nowhere);
  this->Used = 0;
}

std::vector<char> HeldBlocks::missing(const std::vector<char>& active, std::int64_t low)
{
  this->Positions.resize(std::size_t((this->Tuples - 1) >> this->Shift) + 1, nowhere);
  std::vector<char> missing = active;
  const std::uint32_t* const positions = this->Positions.data() + (low >> this->Shift);
  for (std::size_t block = 0; block < missing.size(); ++block)
  {
    missing[block] &= char(positions[block] == nowhere);
  }
  return missing;
}

void HeldBlocks::add(const Run& run)
{
  for (std::int64_t at = 0; at < run.Size; at += std::int64_t(1) << this->Shift)
  {
    this->Positions[std::size_t((run.First + at) >> this->Shift)] = std::uint32_t(this->Used + at);
  }
  this->Used += run.Size;
}

bool HeldBlocks::find(const std::int64_t* ids, std::size_t count, std::uint32_t* positions)
{
  constexpr std::size_t ahead = 512; // the hardware prefetcher stops at page boundaries
  const std::int64_t most = std::min(std::int64_t(count), this->Room - this->Used);
  const auto tuples = std::uint64_t(this->Tuples);
  const int shift = this->Shift; // a local, since writing positions may alias a member
  const std::uint64_t inBlock = this->mask();
  const std::uint32_t* const blocks = this->Positions.data();
  this->Found.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    __builtin_prefetch(ids + i + ahead);
    const auto id = std::uint64_t(ids[i]);
    if (id >= tuples || (blocks[id >> shift] == nowhere && !this->addFound(id >> shift, most)))
    {
      this->loseFound();
      return false;
    }
    positions[i] = blocks[id >> shift] + std::uint32_t(id & inBlock);
  }
  return true;
}

/// Rarely called; inlining it makes find() slower.
[[gnu::noinline]] bool HeldBlocks::addFound(std::uint64_t block, std::int64_t most)
{
  const std::int64_t before = std::int64_t(this->Found.size()) << this->Shift;
  if (before + (std::int64_t(1) << this->Shift) > most)
  {
    return false;
  }
  this->Positions[block] = std::uint32_t(this->Used + before);
  this->Found.push_back(block);
  return true;
}

std::vector<Run> HeldBlocks::found() const
{
  std::vector<Run> runs;
  for (const std::uint64_t block : this->Found)
  {
    const std::int64_t first = std::int64_t(block) << this->Shift;
    const std::int64_t size = std::min(std::int64_t(1) << this->Shift, this->Tuples - first);
    if (!runs.empty() && runs.back().First + runs.back().Size == first)
    {
      runs.back().Size += size;
    }
    else
    {
      runs.push_back({ first, size });
    }
  }
  return runs;
}

void HeldBlocks::keepFound()
{
  this->Used += std::int64_t(this->Found.size()) << this->Shift;
  this->Found.clear();
}

void HeldBlocks::loseFound()
{
  for (const std::uint64_t block : this->Found)
  {
    this->Positions[block] = nowhere;
  }
  this->Found.clear();
}

} // namespace tipp
