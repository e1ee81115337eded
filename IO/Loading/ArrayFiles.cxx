// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/ArrayFiles.h"

#include "Files/IOError.h"

#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace tipp
{

namespace
{

template <std::size_t Bytes>
using Size = std::integral_constant<std::size_t, Bytes>;

/// Calls work(bytes), with a compile-time constant for one of these sizes.
template <std::size_t... Sizes, typename Work>
void withSize(std::index_sequence<Sizes...>, std::size_t bytes, const Work& work)
{
  const bool isUsual = (... || (bytes == Sizes && (work(Size<Sizes>()), true)));
  if (!isUsual)
  {
    work(bytes);
  }
}

using UsualSizes = std::index_sequence<1, 4, 8, 12, 16, 24>;

// The loops are functions of their own: with the lambda's captures, the compiler would load these
// again after each copy, which might have changed them.
template <typename Bytes>
void scatter(const char* from, const std::uint64_t* sources, char* to, const std::uint64_t* targets,
  std::size_t count, Bytes bytes)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    std::memcpy(to + targets[i] * bytes, from + sources[i] * bytes, bytes);
  }
}

template <typename Source, typename Bytes>
void gather(const char* from, const Source* sources, char* to, std::size_t count, Bytes bytes)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    std::memcpy(to + i * bytes, from + sources[i] * bytes, bytes);
  }
}

void requireWhole(const RawArray& array, const InputFile& file)
{
  std::uint64_t bytes = 0;
  if (array.Tuples < 0 || array.Components < 1 ||
    __builtin_mul_overflow(std::uint64_t(array.Tuples), array.tupleBytes(), &bytes) ||
    array.Offset > file.size() || bytes > file.size() - array.Offset)
  {
    throw IOError(file.path(),
      "does not hold the " + std::to_string(array.Tuples) + " tuples of '" + array.Name +
        "' that begin at its byte " + std::to_string(array.Offset) + "; copy or make it again.");
  }
}

constexpr IdRange noIds{ std::numeric_limits<std::int64_t>::max(),
  std::numeric_limits<std::int64_t>::min() };

IdRange unite(const IdRange& a, const IdRange& b)
{
  return { std::min(a.Low, b.Low), std::max(a.High, b.High) };
}

IdRange rangeOf(const std::int64_t* ids, std::size_t count)
{
  constexpr std::size_t lanes = 4;   // independent minima, to avoid a dependency chain
  constexpr std::size_t ahead = 512; // the hardware prefetcher stops at page boundaries
  IdRange parts[lanes] = { noIds, noIds, noIds, noIds };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    __builtin_prefetch(ids + i + ahead);
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      parts[lane] = unite(parts[lane], { ids[i + lane], ids[i + lane] });
    }
  }
  for (; i < count; ++i)
  {
    parts[0] = unite(parts[0], { ids[i], ids[i] });
  }
  return unite(unite(parts[0], parts[1]), unite(parts[2], parts[3]));
}

} // namespace

void scatterTuples(const char* from, const std::uint64_t* sources, char* to,
  const std::uint64_t* targets, std::size_t count, std::size_t bytes)
{
  withSize(
    UsualSizes(), bytes, [=](auto size) { scatter(from, sources, to, targets, count, size); });
}

template <typename Source>
void gatherTuples(
  const char* from, const Source* sources, char* to, std::size_t count, std::size_t bytes)
{
  withSize(UsualSizes(), bytes, [=](auto size) { gather(from, sources, to, count, size); });
}

template void gatherTuples(
  const char*, const std::uint16_t*, char*, std::size_t count, std::size_t bytes);
template void gatherTuples(
  const char*, const std::uint32_t*, char*, std::size_t count, std::size_t bytes);
template void gatherTuples(
  const char*, const std::uint64_t*, char*, std::size_t count, std::size_t bytes);

ArrayFiles::ArrayFiles(std::vector<RawArray> arrays)
  : Arrays(std::move(arrays))
{
  std::map<std::string, std::shared_ptr<InputFile>> open;
  for (const RawArray& array : this->Arrays)
  {
    std::shared_ptr<InputFile>& file = open[array.Path];
    file = file ? file : std::make_shared<InputFile>(array.Path);
    requireWhole(array, *file);
    this->Files.push_back(file);
    this->TupleBytes.push_back(array.tupleBytes());
    this->RecordBytes += this->TupleBytes.back();
    if (array.Tuples != this->Arrays.front().Tuples)
    {
      throw std::invalid_argument("arrays of one loader differ in their numbers of tuples");
    }
  }
  this->Tuples = this->Arrays.empty() ? 0 : this->Arrays.front().Tuples;
}

IdRange ArrayFiles::range(const std::int64_t* ids, std::size_t count, int threads) const
{
  constexpr std::size_t share = 1 << 18;
  const std::size_t shares = (count + share - 1) / share;
  std::vector<IdRange> parts(shares, noIds);
  parallelFor(std::int64_t(shares), threads,
    [&](std::int64_t i)
    {
      const std::size_t begin = std::size_t(i) * share;
      parts[std::size_t(i)] = rangeOf(ids + begin, std::min(share, count - begin));
    });
  IdRange all = noIds;
  for (const IdRange& part : parts)
  {
    all = unite(all, part);
  }
  if (count > 0 && !this->Arrays.empty() && (all.Low < 0 || all.High >= this->Tuples))
  {
    throw IOError(this->Arrays.front().Path,
      "has no vertex " + std::to_string(all.Low < 0 ? all.Low : all.High) + " among its " +
        std::to_string(this->Tuples) + "; correct the cells that name it.");
  }
  return all;
}

void ArrayFiles::read(std::size_t a, std::int64_t first, std::int64_t tuples, void* to, int threads,
  LoadCounters& counters) const
{
  const std::size_t size = this->tupleBytes(a);
  const std::size_t bytes = std::size_t(tuples) * size;
  const std::uint64_t offset = this->Arrays[a].Offset + std::uint64_t(first) * size;
  constexpr std::size_t share = std::size_t(1) << 20;
  if (bytes <= share)
  {
    this->Files[a]->read(offset, to, bytes);
  }
  else
  {
    parallelFor(std::int64_t((bytes + share - 1) / share), threads,
      [&](std::int64_t part)
      {
        const std::size_t begin = std::size_t(part) * share;
        this->Files[a]->read(
          offset + begin, static_cast<char*>(to) + begin, std::min(share, bytes - begin));
      });
  }
  ++counters.Reads;
  counters.Bytes += std::int64_t(bytes);
}

void TupleBuffers::resize(const ArrayFiles& files, std::int64_t tuples)
{
  if (tuples <= this->Tuples)
  {
    return;
  }
  this->Buffers.clear();
  for (std::size_t a = 0; a < files.count(); ++a)
  {
    this->Buffers.emplace_back(std::size_t(tuples) * files.tupleBytes(a));
  }
  this->Tuples = tuples;
}

void GroupedMoves::BlockSort::reset(std::size_t size, std::size_t groups)
{
  if (this->GroupOf.size() < size)
  {
    this->GroupOf.resize(size);
    this->Sources.resize(size);
  }
  this->Next.assign(groups + 1, 0);
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
  this->isWide() ? gatherTuples(room.data(), this->WidePositions.data() + first, to, size, bytes)
                 : gatherTuples(room.data(), this->Positions.data() + first, to, size, bytes);
}

} // namespace tipp
