// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGatherAll_h
#define tippGatherAll_h

#include "Loading/ArrayFiles.h"
#include "Loading/CopyTuples.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>

namespace tipp
{

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

} // namespace tipp

#endif
