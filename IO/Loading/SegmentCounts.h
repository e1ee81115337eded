// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSegmentCounts_h
#define tippSegmentCounts_h

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace tipp
{

/// How many ids of a chunk lie in each segment of the vertices. The chunk is divided into a few
/// shares of consecutive ids, each counted by itself.
struct SegmentCounts
{
  std::vector<std::size_t> ShareStarts;           ///< and the number of ids
  std::vector<std::vector<std::uint32_t>> Shares; ///< a count a segment

  std::size_t shares() const { return this->Shares.size(); }

  /// The bitmap: an element a segment.
  std::vector<char> active() const
  {
    std::vector<char> any(this->Shares.front().size(), 0);
    for (const std::vector<std::uint32_t>& counts : this->Shares)
    {
      std::transform(any.begin(), any.end(), counts.begin(), any.begin(),
        [](char a, std::uint32_t count) { return char(a != 0 || count > 0); });
    }
    return any;
  }
};

/// Ids of a chunk are counted, and sorted, by numbers of 32 bits. Throws std::length_error.
inline void requireCountable(std::size_t ids)
{
  if (ids > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::length_error("a chunk of 2^32 vertex ids or more is asked for");
  }
}

/// Whether there are ids of a chunk in each segment of the vertices; for that alone, quicker than
/// to count them: ids that follow each other are often of one segment, and each count waits for the
/// one before.
template <typename Segment>
std::vector<char> findActive(const std::int64_t* ids, std::size_t count, std::int64_t low,
  std::size_t segments, int threads, const Segment& segment)
{
  constexpr std::size_t least = 1 << 18;
  // As many as there are threads at most, for each has a bitmap.
  const std::size_t shares =
    std::max<std::size_t>(std::min(std::size_t(threadCount(threads)), count / least), 1);
  std::vector<std::vector<char>> parts(shares);
  parallelFor(std::int64_t(shares), threads,
    [&](std::int64_t part)
    {
      std::vector<char> own(segments, 0);
      const std::size_t end = count * (std::size_t(part) + 1) / shares;
      for (std::size_t i = count * std::size_t(part) / shares; i < end; ++i)
      {
        own[segment(std::uint64_t(ids[i] - low))] = 1;
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

/// segment(id - low) is below `segments`. Throws as requireCountable does.
template <typename Segment>
SegmentCounts countSegments(const std::int64_t* ids, std::size_t count, std::int64_t low,
  std::size_t segments, int threads, const Segment& segment)
{
  requireCountable(count);
  constexpr std::size_t least = 1 << 16;
  // Each thread counts for itself, so that there is nothing to wait for.
  const std::size_t shares =
    std::max<std::size_t>(std::min(std::size_t(threadCount(threads)), count / least), 1);
  SegmentCounts result;
  for (std::size_t share = 0; share <= shares; ++share)
  {
    result.ShareStarts.push_back(count * share / shares);
  }
  result.Shares.resize(shares);
  parallelFor(std::int64_t(shares), threads,
    [&](std::int64_t share)
    {
      std::vector<std::uint32_t> own(segments, 0);
      const std::size_t end = result.ShareStarts[std::size_t(share) + 1];
      for (std::size_t i = result.ShareStarts[std::size_t(share)]; i < end; ++i)
      {
        ++own[segment(std::uint64_t(ids[i] - low))];
      }
      result.Shares[std::size_t(share)] = std::move(own);
    });
  return result;
}

} // namespace tipp

#endif
