// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/GroupedMoves.h"

#include "Loading/CopyTuples.h"
#include "Loading/GatherAll.h"

#include <algorithm>
#include <array>

namespace tipp
{

/// Without setting them: all are written before they are read.
void GroupedMoves::reserve(std::size_t count)
{
  if (count > this->Room)
  {
    this->Room = 0;
    this->Moves.reset(); // not two at a time
    this->Moves.reset(new Move[count]);
    this->Room = count;
  }
}

void GroupedMoves::scatter(std::size_t group, const ArrayFiles& files, TupleBuffers& buffers,
  void* const* out, int threads) const
{
  const Move* const moves = this->Moves.get() + this->Starts[group];
  const std::size_t count = this->Starts[group + 1] - this->Starts[group];
  constexpr std::size_t share = 1 << 16;
  parallelFor(std::int64_t((count + share - 1) / share), threads,
    [&](std::int64_t part)
    {
      const std::size_t end = std::min((std::size_t(part) + 1) * share, count);
      std::array<std::uint64_t, tuplesAtATime> sources;
      std::array<std::uint64_t, tuplesAtATime> targets;
      for (std::size_t first = std::size_t(part) * share; first < end; first += tuplesAtATime)
      {
        const std::size_t size = std::min(tuplesAtATime, end - first);
        for (std::size_t i = 0; i < size; ++i)
        {
          sources[i] = moves[first + i].Source;
          targets[i] = moves[first + i].Target;
        }
        for (std::size_t a = 0; a < files.count(); ++a)
        {
          scatterTuples(buffers.data(a), sources.data(), static_cast<char*>(out[a]), targets.data(),
            size, files.tupleBytes(a));
        }
      }
    });
}

} // namespace tipp
