// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRuns_h
#define tippRuns_h

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// Consecutive tuples that one read loads.
struct Run
{
  std::int64_t First;
  std::int64_t Size;
};

/// Returns the active blocks, of `block` tuples each, as runs within [low, high). Runs less than
/// `gap` tuples apart are merged.
std::vector<Run> runsOfBlocks(const std::vector<char>& active, std::int64_t block, std::int64_t low,
  std::int64_t high, std::int64_t gap);

/// The same for single ids, the first members of the pairs, in ascending order.
std::vector<Run> runsOfIds(
  const std::vector<std::pair<std::int64_t, std::uint32_t>>& ids, std::int64_t gap);

/// Cuts runs into groups of at most m tuples. Returns the index of each group's first run in the
/// cut runs, and then the number of runs. Runs are cut at multiples of `block` tuples from `low`.
std::vector<std::size_t> groupRuns(
  std::vector<Run>& runs, std::int64_t m, std::int64_t block, std::int64_t low);

/// Runs in groups, and each run's position in the buffer of its group.
struct RunPlan
{
  RunPlan(std::vector<Run> runs, std::int64_t m, std::int64_t block, std::int64_t low);

  std::size_t groups() const { return this->Starts.size() - 1; }

  std::vector<tipp::Run> Runs;
  std::vector<std::size_t> Starts;    ///< first run of each group, and the number of runs
  std::vector<std::uint32_t> Packed;  ///< position of each run in tuples; m is below 2^32
  std::vector<std::uint32_t> GroupOf; ///< group of each run
};

} // namespace tipp

#endif
