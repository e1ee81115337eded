// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGroupedMoves_h
#define tippGroupedMoves_h

#include "Loading/ArrayFiles.h"
#include "Loading/SegmentCounts.h"
#include "Parallel/ParallelFor.h"

#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace tipp
{

/// Where the tuples of a chunk go, group by group: a group is what is in the buffers together. To
/// sort them once is quicker than to look at all ids for each group.
class GroupedMoves
{
public:
  /// A counting sort. Counts are of segments, each of which lies in one group; where(id) gives an
  /// id's group and its place in the buffers.
  template <typename Where>
  void sort(const std::int64_t* ids, const SegmentCounts& counts,
    const std::vector<std::uint32_t>& groupOf, std::size_t groups, int threads, const Where& where)
  {
    std::vector<std::vector<std::size_t>> next(counts.shares());
    for (std::size_t share = 0; share < counts.shares(); ++share)
    {
      next[share].assign(groups, 0);
      for (std::size_t segment = 0; segment < groupOf.size(); ++segment)
      {
        next[share][groupOf[segment]] += counts.Shares[share][segment];
      }
    }
    this->Starts.clear();
    std::size_t at = 0;
    for (std::size_t group = 0; group < groups; ++group)
    {
      this->Starts.push_back(at);
      for (std::vector<std::size_t>& own : next)
      {
        at += std::exchange(own[group], at);
      }
    }
    this->Starts.push_back(at);
    this->reserve(at);
    parallelFor(std::int64_t(counts.shares()), threads,
      [&](std::int64_t share)
      {
        std::vector<std::size_t>& own = next[std::size_t(share)];
        const std::size_t end = counts.ShareStarts[std::size_t(share) + 1];
        for (std::size_t i = counts.ShareStarts[std::size_t(share)]; i < end; ++i)
        {
          const auto [group, source] = where(ids[i]);
          this->Moves[own[group]++] = { source, std::uint32_t(i) };
        }
      });
  }

  /// The same of a few: where(number) for the number of each id of the chunk.
  template <typename Where>
  void sort(const std::vector<std::uint32_t>& numbers, std::size_t groups, const Where& where)
  {
    this->Starts.assign(groups + 1, 0);
    for (const std::uint32_t number : numbers)
    {
      ++this->Starts[where(number).first + 1];
    }
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    this->reserve(numbers.size());
    std::vector<std::size_t> next = this->Starts;
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      const auto [group, source] = where(numbers[i]);
      this->Moves[next[group]++] = { source, std::uint32_t(i) };
    }
  }

  /// Copies a group's tuples from the buffers to their places in the chunk.
  void scatter(std::size_t group, const ArrayFiles& files, TupleBuffers& buffers, void* const* out,
    int threads) const;

private:
  struct Move
  {
    std::uint32_t Source; ///< in the buffers
    std::uint32_t Target; ///< in the chunk
  };

  void reserve(std::size_t count);

  std::unique_ptr<Move[]> Moves;
  std::size_t Room = 0;
  std::vector<std::size_t> Starts; ///< of the groups, and the number of moves
};

} // namespace tipp

#endif
