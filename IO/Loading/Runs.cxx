// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/Runs.h"

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

namespace
{

void append(std::vector<Run>& runs, const Run& run, std::int64_t gap)
{
  if (!runs.empty() && run.First - (runs.back().First + runs.back().Size) < gap)
  {
    runs.back().Size = run.First + run.Size - runs.back().First;
  }
  else
  {
    runs.push_back(run);
  }
}

} // namespace

std::vector<Run> runsOfBlocks(const std::vector<char>& active, std::int64_t block, std::int64_t low,
  std::int64_t high, std::int64_t gap)
{
  std::vector<Run> runs;
  for (std::size_t i = 0; i < active.size(); ++i)
  {
    if (active[i] != 0)
    {
      const std::int64_t first = low + std::int64_t(i) * block;
      append(runs, { first, std::min(block, high + 1 - first) }, std::max<std::int64_t>(gap, 1));
    }
  }
  return runs;
}

std::vector<Run> runsOfIds(
  const std::vector<std::pair<std::int64_t, std::uint32_t>>& ids, std::int64_t gap)
{
  std::vector<Run> runs;
  for (const auto& pair : ids)
  {
    if (runs.empty() || pair.first >= runs.back().First + runs.back().Size)
    {
      append(runs, { pair.first, 1 }, std::max<std::int64_t>(gap, 1));
    }
  }
  return runs;
}

std::vector<std::size_t> groupRuns(
  std::vector<Run>& runs, std::int64_t m, std::int64_t block, std::int64_t low)
{
  std::vector<Run> cut;
  std::vector<std::size_t> starts{ 0 };
  std::int64_t room = m;
  for (Run run : runs)
  {
    while (run.Size > room)
    {
      // A whole number of blocks, so that no tiny run remains.
      const std::int64_t end = run.First + room - (run.First + room - low) % block;
      const std::int64_t size = end - run.First;
      if (size > 0)
      {
        cut.push_back({ run.First, size });
        run = { end, run.Size - size };
      }
      if (cut.size() > starts.back())
      {
        starts.push_back(cut.size());
      }
      room = m;
    }
    cut.push_back(run);
    room -= run.Size;
  }
  starts.push_back(cut.size());
  runs = std::move(cut);
  return starts;
}

RunPlan::RunPlan(std::vector<Run> runs, std::int64_t m, std::int64_t block, std::int64_t low)
  : Runs(std::move(runs))
  , Starts(groupRuns(this->Runs, m, block, low))
{
  for (std::size_t group = 0; group < this->groups(); ++group)
  {
    std::uint32_t packed = 0;
    for (std::size_t i = this->Starts[group]; i < this->Starts[group + 1]; ++i)
    {
      this->Packed.push_back(packed);
      this->GroupOf.push_back(std::uint32_t(group));
      packed += std::uint32_t(this->Runs[i].Size);
    }
  }
}

} // namespace tipp
