// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGroupedMoves_h
#define tippGroupedMoves_h

#include "Arrays/Buffer.h"
#include "Loading/ArrayFiles.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Replaces an array that has fewer than `count` numbers.
template <typename Number>
void makeRoom(Buffer<Number>& numbers, std::size_t count)
{
  if (count > numbers.size())
  {
    numbers = Buffer<Number>(); // so that the old and the new array do not exist together
    numbers = Buffer<Number>(count);
  }
}

/// The source positions of a chunk's tuples, group by group; a group is what the buffers hold at
/// the same time. The chunk is cut into blocks that fit in the processor's cache. In each block of
/// the caller's arrays the tuples are first stored by group, so that few cache lines are written by
/// several groups; the last group puts the tuples of each block in order.
class GroupedMoves
{
public:
  /// where(i) returns the group of the chunk's i-th id and its position in the buffers.
  template <typename Where>
  void sort(std::size_t count, std::size_t groups, int threads, const Where& where)
  {
    this->reset(count, groups);
    std::vector<BlockSort> sorts(this->threadsFor(threads));
    forChunks(std::int64_t(this->Blocks), 1, int(sorts.size()), {},
      [&](std::int64_t block, std::int64_t, int thread)
      {
        BlockSort& own = sorts[std::size_t(thread)];
        const std::size_t first = std::size_t(block) * this->BlockSize;
        const std::size_t size = this->sizeOf(std::size_t(block));
        own.reset(size, groups);
        for (std::size_t i = 0; i < size; ++i)
        {
          const auto [group, source] = where(first + i);
          own.GroupOf[i] = std::uint32_t(group);
          own.Sources[i] = source;
          ++own.Next[std::size_t(group) + 1];
        }
        this->sortByGroup(std::size_t(block), own);
      });
  }

  /// The groups that have tuples in the chunk, ascending.
  std::vector<std::size_t> wanted() const;

  /// Copies a group's tuples from the buffers into the blocks. Each group is to be passed once, in
  /// any order; the last one completes the chunk.
  void gather(std::size_t group, bool isLast, const ArrayFiles& files, TupleBuffers& buffers,
    void* const* out, int threads) const;

private:
  /// A thread's workspace for sorting a block.
  struct BlockSort
  {
    void reset(std::size_t size, std::size_t groups);

    std::vector<std::uint32_t> GroupOf;
    std::vector<std::uint32_t> Sources;
    std::vector<std::uint32_t> Next; ///< per group: first its count, then its next position
  };

  void reset(std::size_t count, std::size_t groups);
  void sortByGroup(std::size_t block, BlockSort& own);
  template <typename Position>
  void sortByGroup(
    BlockSort& own, std::size_t size, std::uint32_t* sources, Position* positions) const;
  void complete(std::size_t block, std::size_t group, const char* from, char* to, std::size_t bytes,
    std::vector<char>& room) const;

  std::size_t sizeOf(std::size_t block) const
  {
    return std::min(this->BlockSize, this->Count - block * this->BlockSize);
  }
  const std::uint32_t* startsOf(std::size_t block) const
  {
    return this->Starts.data() + block * (this->Groups + 1);
  }
  std::size_t threadsFor(int threads) const
  {
    return std::max<std::size_t>(std::min(std::size_t(threadCount(threads)), this->Blocks), 1);
  }
  bool isWide() const;

  std::size_t Count = 0;
  std::size_t Groups = 0;
  std::size_t BlockSize = 0;
  std::size_t Blocks = 0;
  /// Positions in the buffers, for each block sorted by group.
  Buffer<std::uint32_t> Sources;
  /// The position of each id within its block; isWide says which of the two arrays is in use.
  Buffer<std::uint16_t> Positions;
  Buffer<std::uint32_t> WidePositions;
  std::vector<std::uint32_t> Starts; ///< start of each group in each block, and the block's size
  std::vector<char> InOrder;         ///< per block: it has one group only, and so no positions
};

} // namespace tipp

#endif
