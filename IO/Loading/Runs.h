// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRuns_h
#define tippRuns_h

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// The distinct ids of a chunk: a vertex belongs to several cells, to six triangles on average in a
/// planar mesh.
struct UniqueIds
{
  /// Throws std::length_error for 2^32 ids or more. Ids must not be negative.
  UniqueIds(const std::int64_t* ids, std::size_t count);

  /// each distinct id and its number, sorted by id
  std::vector<std::pair<std::int64_t, std::uint32_t>> Sorted;
  std::vector<std::uint32_t> Numbers; ///< the number of each of the chunk's ids
};

/// Returns the bitmap of active segments, one element per segment: whether a chunk has ids in it.
/// segment(id - low) is less than `segments`.
template <typename Segment>
std::vector<char> findActive(const std::int64_t* ids, std::size_t count, std::int64_t low,
  std::size_t segments, int threads, const Segment& segment)
{
  constexpr std::size_t least = 1 << 18;
  // Each thread has a bitmap of its own, so the number of threads bounds the number of bitmaps.
  const std::size_t shares =
    std::max<std::size_t>(std::min(std::size_t(threadCount(threads)), count / least), 1);
  std::vector<std::vector<char>> parts(shares);
  parallelFor(std::int64_t(shares), threads,
    [&](std::int64_t part)
    {
      std::vector<char> own(segments, 0);
      char* const active = own.data(); // a local, since writing a char may alias a member
      const std::size_t end = count * (std::size_t(part) + 1) / shares;
      for (std::size_t i = count * std::size_t(part) / shares; i < end; ++i)
      {
        active[segment(std::uint64_t(ids[i] - low))] = 1;
      }
      parts[std::size_t(part)] = std::move(own);
    });
  for (std::size_t part = 1; part < shares; ++part)
  {
    std::transform(parts[part].begin(), parts[part].end(), parts[0].begin(), parts[0].begin(),
      [](char a, char b) { return char(a | b); });
  }
  return std::move(parts[0]);
}

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
