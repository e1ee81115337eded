// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/ArrayFiles.h"

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
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

namespace
{

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
    this->RecordBytes += array.tupleBytes();
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

} // namespace tipp
