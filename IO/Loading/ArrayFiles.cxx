// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/ArrayFiles.h"

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace tipp
{
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
  constexpr std::int64_t share = 1 << 18;
  const auto size = std::int64_t(count);
  const std::int64_t shares = (size + share - 1) / share;
  const IdRange none{ std::numeric_limits<std::int64_t>::max(),
    std::numeric_limits<std::int64_t>::min() };
  std::vector<IdRange> parts(std::size_t(shares), none);
  parallelFor(shares, threads,
    [&](std::int64_t i)
    {
      IdRange part = none;
      const std::int64_t end = std::min((i + 1) * share, size);
      for (std::int64_t k = i * share; k < end; ++k)
      {
        part.Low = std::min(part.Low, ids[k]);
        part.High = std::max(part.High, ids[k]);
      }
      parts[std::size_t(i)] = part;
    });
  IdRange all = none;
  for (const IdRange& part : parts)
  {
    all.Low = std::min(all.Low, part.Low);
    all.High = std::max(all.High, part.High);
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
    // Not cleared: it is filled by a read before it is used.
    this->Buffers.emplace_back(new char[std::size_t(tuples) * files.tupleBytes(a)]);
  }
  this->Tuples = tuples;
}

} // namespace tipp
