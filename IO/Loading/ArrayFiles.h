// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippArrayFiles_h
#define tippArrayFiles_h

#include "Arrays/Buffer.h"
#include "Files/InputFile.h"
#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
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
  /// Throws as makeVertexLoader does.
  explicit ArrayFiles(std::vector<RawArray> arrays);

  std::size_t count() const { return this->Arrays.size(); }
  const RawArray& array(std::size_t a) const { return this->Arrays[a]; }
  const InputFile& file(std::size_t a) const { return *this->Files[a]; }
  std::size_t tupleBytes(std::size_t a) const { return this->Arrays[a].tupleBytes(); }
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
  std::int64_t Tuples = 0;
  std::size_t RecordBytes = 0;
};

/// Buffers for a number of tuples of every array.
class TupleBuffers
{
public:
  void resize(const ArrayFiles& files, std::int64_t tuples);
  char* data(std::size_t a) { return this->Buffers[a].data(); }

private:
  std::vector<Buffer<char>> Buffers;
  std::int64_t Tuples = 0;
};

/// Creates a loader of the kind Loader::Fine; `m` is at least 1.
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

} // namespace tipp

#endif
