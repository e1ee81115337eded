// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIdGroups_h
#define tippIdGroups_h

#include "Threads/ParallelFor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The places of ids in a chunk, sorted by the group that each id belongs to; within a group they
/// ascend. So a group's ids are found without a look at all the others.
struct IdGroups
{
  std::vector<std::uint32_t> Places;
  std::vector<std::size_t> Starts; ///< where each group begins, and the number of places
};

/// A counting sort; group(id - low) is below `groups`. The chunk has less than 2^32 ids.
template <typename Group>
IdGroups groupIds(const std::int64_t* ids, std::size_t count, std::int64_t low, std::size_t groups,
  int threads, const Group& group)
{
  constexpr std::size_t least = 1 << 16;
  const std::size_t shares =
    std::max<std::size_t>(std::min(std::size_t(threadCount(threads)), count / least), 1);
  const auto shareStart = [&](std::size_t share) { return count * share / shares; };
  std::vector<std::vector<std::size_t>> counts(shares);
  parallelFor(std::int64_t(shares), threads,
    [&](std::int64_t share)
    {
      std::vector<std::size_t> own(groups, 0);
      const std::size_t end = shareStart(std::size_t(share) + 1);
      for (std::size_t i = shareStart(std::size_t(share)); i < end; ++i)
      {
        ++own[group(std::uint64_t(ids[i] - low))];
      }
      counts[std::size_t(share)] = std::move(own);
    });
  IdGroups result;
  std::size_t at = 0;
  for (std::size_t g = 0; g < groups; ++g)
  {
    result.Starts.push_back(at);
    for (std::vector<std::size_t>& own : counts)
    {
      const std::size_t size = own[g];
      own[g] = at;
      at += size;
    }
  }
  result.Starts.push_back(at);
  result.Places.resize(count);
  parallelFor(std::int64_t(shares), threads,
    [&](std::int64_t share)
    {
      std::vector<std::size_t>& next = counts[std::size_t(share)];
      const std::size_t end = shareStart(std::size_t(share) + 1);
      for (std::size_t i = shareStart(std::size_t(share)); i < end; ++i)
      {
        result.Places[next[group(std::uint64_t(ids[i] - low))]++] = std::uint32_t(i);
      }
    });
  return result;
}

} // namespace tipp

#endif
