// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScatterRange_h
#define tippScatterRange_h

#include "Loading/ArrayFiles.h"
#include "Loading/CopyTuples.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>

namespace tipp
{

/// The ids of a chunk that lie in First ... First + Size - 1.
struct WantedTuples
{
  const std::int64_t* Ids;
  std::size_t Count;
  std::int64_t First;
  std::int64_t Size;
};

constexpr std::size_t scatterBlock = 2048;

/// Places of tuples in the buffers and in the chunk, for a few tuples at a time.
struct TuplePlaces
{
  std::array<std::uint64_t, scatterBlock> Sources;
  std::array<std::uint64_t, scatterBlock> Targets;

  void copy(
    std::size_t count, const ArrayFiles& files, TupleBuffers& buffers, void* const* out) const
  {
    for (std::size_t a = 0; a < files.count(); ++a)
    {
      scatterTuples(buffers.data(a), this->Sources.data(), static_cast<char*>(out[a]),
        this->Targets.data(), count, files.tupleBytes(a));
    }
  }
};

/// One thread's part of scatterRange: ids from `begin` on up to `end`.
template <typename Place>
void scatterPart(const WantedTuples& wanted, std::size_t begin, std::size_t end,
  const ArrayFiles& files, TupleBuffers& buffers, void* const* out, const Place& place)
{
  TuplePlaces places;
  for (std::size_t first = begin; first < end; first += scatterBlock)
  {
    const std::size_t last = std::min(first + scatterBlock, end);
    std::size_t found = 0;
    for (std::size_t i = first; i < last; ++i)
    {
      // Without a branch, which would be taken at random: an id that is not wanted is written over.
      const auto relative = std::uint64_t(wanted.Ids[i]) - std::uint64_t(wanted.First);
      places.Sources[found] = relative;
      places.Targets[found] = i;
      found += relative < std::uint64_t(wanted.Size) ? 1 : 0;
    }
    for (std::size_t i = 0; i < found; ++i)
    {
      places.Sources[i] = place(places.Sources[i]);
    }
    places.copy(found, files, buffers, out);
  }
}

/// Copies the wanted tuples from the buffers to their places in the chunk. place(id - First) is
/// where in the buffers an id's tuple lies.
template <typename Place>
void scatterRange(const WantedTuples& wanted, const ArrayFiles& files, TupleBuffers& buffers,
  void* const* out, int threads, const Place& place)
{
  constexpr std::size_t share = 1 << 17;
  parallelFor(std::int64_t((wanted.Count + share - 1) / share), threads,
    [&](std::int64_t i)
    {
      const std::size_t begin = std::size_t(i) * share;
      scatterPart(wanted, begin, std::min(begin + share, wanted.Count), files, buffers, out, place);
    });
}

/// Copies all tuples of a chunk: the one at source(i) in the buffers to place i.
template <typename Source>
void gatherAll(std::size_t count, const ArrayFiles& files, TupleBuffers& buffers, void* const* out,
  int threads, const Source& source)
{
  constexpr std::size_t share = 1 << 17;
  parallelFor(std::int64_t((count + share - 1) / share), threads,
    [&](std::int64_t part)
    {
      const std::size_t end = std::min((std::size_t(part) + 1) * share, count);
      std::array<std::uint64_t, scatterBlock> sources;
      for (std::size_t first = std::size_t(part) * share; first < end; first += scatterBlock)
      {
        const std::size_t size = std::min(scatterBlock, end - first);
        for (std::size_t i = 0; i < size; ++i)
        {
          sources[i] = source(first + i);
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

/// Where a tuple lies in the buffers, and where in the chunk it goes.
struct Move
{
  std::uint32_t Source;
  std::uint32_t Target;
};

/// Copies tuples from the buffers to their places in the chunk.
inline void scatterMoves(const Move* moves, std::size_t count, const ArrayFiles& files,
  TupleBuffers& buffers, void* const* out, int threads)
{
  constexpr std::size_t share = 1 << 16;
  parallelFor(std::int64_t((count + share - 1) / share), threads,
    [&](std::int64_t part)
    {
      const std::size_t end = std::min((std::size_t(part) + 1) * share, count);
      TuplePlaces places;
      for (std::size_t first = std::size_t(part) * share; first < end; first += scatterBlock)
      {
        const std::size_t size = std::min(scatterBlock, end - first);
        for (std::size_t i = 0; i < size; ++i)
        {
          places.Sources[i] = moves[first + i].Source;
          places.Targets[i] = moves[first + i].Target;
        }
        places.copy(size, files, buffers, out);
      }
    });
}

} // namespace tipp

#endif
