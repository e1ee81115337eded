// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/GroupedMoves.h"

#include "Loading/ArrayFiles.h"

#include <limits>
#include <numeric>

namespace tipp
{

void GroupedMoves::BlockSort::reset(std::size_t size, std::size_t groups)
{
  if (this->GroupOf.size() < size)
  {
    this->GroupOf.resize(size);
    this->Sources.resize(size);
  }
  this->Next.assign(groups + 1, 0);
}

bool GroupedMoves::isWide() const
{
  return this->BlockSize - 1 > std::numeric_limits<std::uint16_t>::max();
}

void GroupedMoves::reset(std::size_t count, std::size_t groups)
{
  constexpr std::size_t least = 8192; // 128 KiB of 2D points
  constexpr std::size_t ofEach = 16;  // tuples per group, so that the array of starts stays small
  this->Count = count;
  this->Groups = groups;
  this->BlockSize = std::max(least, ofEach * groups);
  this->Blocks = (count + this->BlockSize - 1) / this->BlockSize;
  this->Starts.resize(this->Blocks * (groups + 1));
  this->InOrder.resize(this->Blocks);
  makeRoom(this->Sources, count);
  this->isWide() ? makeRoom(this->WidePositions, count) : makeRoom(this->Positions, count);
}

void GroupedMoves::sortByGroup(std::size_t block, BlockSort& own)
{
  const std::size_t size = this->sizeOf(block);
  const std::size_t first = block * this->BlockSize;
  const bool isOfOneGroup = own.Next[own.GroupOf[0] + 1] == size;
  std::partial_sum(own.Next.begin(), own.Next.end(), own.Next.begin());
  std::copy(own.Next.begin(), own.Next.end(),
    this->Starts.begin() + std::ptrdiff_t(block * (this->Groups + 1)));
  this->InOrder[block] = char(isOfOneGroup);
  std::uint32_t* const sources = this->Sources.data() + first;
  if (isOfOneGroup)
  {
    std::copy_n(own.Sources.begin(), size, sources);
  }
  else if (this->isWide())
  {
    this->sortByGroup(own, size, sources, this->WidePositions.data() + first);
  }
  else
  {
    this->sortByGroup(own, size, sources, this->Positions.data() + first);
  }
}

template <typename Position>
void GroupedMoves::sortByGroup(
  BlockSort& own, std::size_t size, std::uint32_t* sources, Position* positions) const
{
  for (std::size_t i = 0; i < size; ++i)
  {
    const std::uint32_t position = own.Next[own.GroupOf[i]]++;
    sources[position] = own.Sources[i];
    positions[i] = Position(position);
  }
}

std::vector<std::size_t> GroupedMoves::wanted() const
{
  std::vector<char> any(this->Groups, 0);
  for (std::size_t block = 0; block < this->Blocks; ++block)
  {
    const std::uint32_t* const starts = this->startsOf(block);
    for (std::size_t group = 0; group < this->Groups; ++group)
    {
      any[group] |= char(starts[group] != starts[group + 1]);
    }
  }
  std::vector<std::size_t> groups;
  for (std::size_t group = 0; group < this->Groups; ++group)
  {
    if (any[group] != 0)
    {
      groups.push_back(group);
    }
  }
  return groups;
}

void GroupedMoves::gather(std::size_t group, bool isLast, const ArrayFiles& files,
  TupleBuffers& buffers, void* const* out, int threads) const
{
  std::vector<std::vector<char>> rooms(this->threadsFor(threads));
  forChunks(std::int64_t(this->Blocks), 1, int(rooms.size()), {},
    [&](std::int64_t index, std::int64_t, int thread)
    {
      const auto block = std::size_t(index);
      const std::uint32_t* const starts = this->startsOf(block) + group;
      for (std::size_t a = 0; a < files.count(); ++a)
      {
        const std::size_t bytes = files.tupleBytes(a);
        char* const to = static_cast<char*>(out[a]) + block * this->BlockSize * bytes;
        if (isLast && this->InOrder[block] == 0)
        {
          this->complete(block, group, buffers.data(a), to, bytes, rooms[std::size_t(thread)]);
          continue;
        }
        gatherTuples(buffers.data(a), this->Sources.data() + block * this->BlockSize + starts[0],
          to + starts[0] * bytes, starts[1] - starts[0], bytes);
      }
    });
}

/// Puts a block in order when only one group's tuples are missing.
void GroupedMoves::complete(std::size_t block, std::size_t group, const char* from, char* to,
  std::size_t bytes, std::vector<char>& room) const
{
  const std::size_t first = block * this->BlockSize;
  const std::size_t size = this->sizeOf(block);
  const std::size_t begin = this->startsOf(block)[group];
  const std::size_t end = this->startsOf(block)[group + 1];
  if (room.size() < size * bytes)
  {
    room.resize(size * bytes);
  }
  std::copy_n(to, begin * bytes, room.data());
  gatherTuples(
    from, this->Sources.data() + first + begin, room.data() + begin * bytes, end - begin, bytes);
  std::copy_n(to + end * bytes, (size - end) * bytes, room.data() + end * bytes);
  if (this->isWide())
  {
    gatherTuples(room.data(), this->WidePositions.data() + first, to, size, bytes);
  }
  else
  {
    gatherTuples(room.data(), this->Positions.data() + first, to, size, bytes);
  }
}

} // namespace tipp
