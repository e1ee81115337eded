// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRuns_h
#define tippRuns_h

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// Consecutive tuples that are read at once.
struct Run
{
  std::int64_t First;
  std::int64_t Size;
};

/// Active blocks of `block` tuples as runs, from tuple `low` up to `high`. Runs with less than
/// `gap` tuples between them become one.
std::vector<Run> runsOfBlocks(const std::vector<char>& active, std::int64_t block, std::int64_t low,
  std::int64_t high, std::int64_t gap);

/// The same for single ids, which come first in their pairs and ascend.
std::vector<Run> runsOfIds(
  const std::vector<std::pair<std::int64_t, std::uint32_t>>& ids, std::int64_t gap);

/// Cuts runs into groups of at most m tuples: the index in the cut runs where each group begins,
/// and the number of runs at the end. A run is cut at a multiple of `block` tuples from `low`.
std::vector<std::size_t> groupRuns(
  std::vector<Run>& runs, std::int64_t m, std::int64_t block, std::int64_t low);

/// Runs in groups, and where each run is packed in its group's buffer.
struct RunPlan
{
  RunPlan(std::vector<Run> runs, std::int64_t m, std::int64_t block, std::int64_t low);

  std::size_t groups() const { return this->Starts.size() - 1; }

  std::vector<tipp::Run> Runs;
  std::vector<std::size_t> Starts;    ///< of the groups, and the number of runs
  std::vector<std::uint32_t> Packed;  ///< of each run; m is below 2^32
  std::vector<std::uint32_t> GroupOf; ///< of each run
};

} // namespace tipp

#endif
