// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippActiveSegments_h
#define tippActiveSegments_h

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

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

} // namespace tipp

#endif
