// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippArrayFiles_h
#define tippArrayFiles_h

#include "Arrays/Buffer.h"
#include "Files/InputFile.h"
#include "Files/RawArray.h"
#include "Loading/VertexLoader.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// Divides numbers below 2^63 by an invariant divisor, at the cost of a multiplication.
class Divisor
{
public:
  explicit Divisor(std::uint64_t divisor)
    : Value(divisor)
    , Reciprocal(~std::uint64_t(0) / divisor)
  {
  }

  std::uint64_t quotient(std::uint64_t dividend) const
  {
    __extension__ using Wide = unsigned __int128;
    // The reciprocal is too small by less than two, so the quotient by at most one.
    const auto low = std::uint64_t(Wide(dividend) * this->Reciprocal >> 64);
    return low + (dividend - low * this->Value >= this->Value ? 1 : 0);
  }

private:
  std::uint64_t Value;
  std::uint64_t Reciprocal;
};

/// The least and greatest id; Low > High if there are no ids.
struct IdRange
{
  std::int64_t Low;
  std::int64_t High;
};

/// Open files of arrays with the same number of tuples, and the operations that all loaders share.
class ArrayFiles
{
public:
  /// Throws IOError if a file cannot be opened or is too short for its array; std::invalid_argument
  /// if the arrays' numbers of tuples differ.
  explicit ArrayFiles(std::vector<RawArray> arrays);

  std::size_t count() const { return this->Arrays.size(); }
  const RawArray& array(std::size_t a) const { return this->Arrays[a]; }
  const InputFile& file(std::size_t a) const { return *this->Files[a]; }
  std::size_t tupleBytes(std::size_t a) const { return this->TupleBytes[a]; }
  std::int64_t tuples() const { return this->Tuples; }
  /// The bytes of one tuple of every array.
  std::size_t recordBytes() const { return this->RecordBytes; }

  /// Returns the range of ids. Throws IOError naming an id that is not a tuple's index.
  IdRange range(const std::int64_t* ids, std::size_t count, int threads) const;

  /// Reads consecutive tuples of array `a`, and counts that as one read. Large reads are split over
  /// threads: if the file is cached, reading is copying.
  void read(std::size_t a, std::int64_t first, std::int64_t tuples, void* to, int threads,
    LoadCounters& counters) const;

private:
  std::vector<RawArray> Arrays;
  std::vector<std::shared_ptr<InputFile>> Files;
  std::vector<std::size_t> TupleBytes; ///< per array
  std::int64_t Tuples = 0;
  std::size_t RecordBytes = 0;
};

/// The base of all loaders: the open files, and the number of threads (0: defaultThreads()).
class FileLoader : public VertexLoader
{
protected:
  FileLoader(ArrayFiles files, int threads)
    : Files(std::move(files))
    , Threads(threads)
  {
  }

  ArrayFiles Files;
  int Threads;
};

/// Buffers for a number of tuples of every array.
class TupleBuffers
{
public:
  void resize(const ArrayFiles& files, std::int64_t tuples);
  char* data(std::size_t a) { return this->Buffers[a].data(); }
  const char* data(std::size_t a) const { return this->Buffers[a].data(); }

private:
  std::vector<Buffer<char>> Buffers;
  std::int64_t Tuples = 0;
};

/// Creates a loader of the kind Loader::Fine; `m` is at least 1 and below 2^32.
std::unique_ptr<VertexLoader> makeFineLoader(ArrayFiles files, std::int64_t m, int threads);

/// to[targets[i]] = from[sources[i]]; positions are in tuples of `bytes` bytes.
void scatterTuples(const char* from, const std::uint64_t* sources, char* to,
  const std::uint64_t* targets, std::size_t count, std::size_t bytes);

/// to[i] = from[sources[i]]; positions are in tuples of `bytes` bytes. Source is an integer of 16,
/// 32 or 64 bits.
template <typename Source>
void gatherTuples(
  const char* from, const Source* sources, char* to, std::size_t count, std::size_t bytes);

/// The number of tuples whose positions are computed before they are copied.
constexpr std::size_t tuplesAtATime = 2048;

/// Copies all tuples of a chunk: tuple source(i) of the buffers, a 32-bit position, to tuple i of
/// the output.
template <typename Source>
void gatherAll(std::size_t count, const ArrayFiles& files, TupleBuffers& buffers, void* const* out,
  int threads, const Source& source)
{
  constexpr std::size_t share = 1 << 17;
  parallelFor(std::int64_t((count + share - 1) / share), threads,
    [&](std::int64_t part)
    {
      const std::size_t end = std::min((std::size_t(part) + 1) * share, count);
      std::array<std::uint32_t, tuplesAtATime> sources;
      for (std::size_t first = std::size_t(part) * share; first < end; first += tuplesAtATime)
      {
        const std::size_t size = std::min(tuplesAtATime, end - first);
        for (std::size_t i = 0; i < size; ++i)
        {
          sources[i] = std::uint32_t(source(first + i));
        }
        for (std::size_t a = 0; a < files.count(); ++a)
        {
          const std::size_t bytes = files.tupleBytes(a);
          gatherTuples(buffers.data(a), sources.data(), static_cast<char*>(out[a]) + first * bytes,
            size, bytes);
        }
      }
    });
}

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
  bool isWide() const { return this->BlockSize > std::size_t(1) << 16; }

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
