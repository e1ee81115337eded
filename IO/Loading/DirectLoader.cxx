// SPDX-License-Identifier: BSD-3-Clause
// Direct Load: Algorithm 4 of the dissertation "Efficient Generating and Processing of Large-Scale
// Unstructured Meshes".
#include "Loading/VertexLoader.h"

#include "Files/IOError.h"
#include "Loading/ArrayFiles.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include <sys/mman.h>
#include <unistd.h>

namespace tipp
{
namespace
{

/// An array mapped into memory. Truncating the file while it is mapped ends the process (SIGBUS),
/// as for any mapped file.
class Mapping
{
public:
  Mapping(const RawArray& array, const InputFile& file)
  {
    const auto page = std::uint64_t(sysconf(_SC_PAGESIZE));
    const std::uint64_t start = array.Offset / page * page;
    const std::uint64_t inside = array.Offset - start;
    this->Bytes = std::size_t(array.bytes() + inside);
    this->Start =
      mmap(nullptr, this->Bytes, PROT_READ, MAP_SHARED, file.descriptor(), off_t(start));
    if (this->Start == MAP_FAILED)
    {
      throw IOError(file.path(),
        std::string("cannot be mapped into memory (") + std::strerror(errno) +
          "); choose another loader.");
    }
    // Read ahead sequentially rather than page by page in the order of the ids.
    madvise(this->Start, this->Bytes, MADV_WILLNEED);
    this->Tuples = static_cast<const char*>(this->Start) + inside;
  }
  ~Mapping() { munmap(this->Start, this->Bytes); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  const char* tuples() const { return this->Tuples; }

private:
  void* Start;
  std::size_t Bytes;
  const char* Tuples;
};

class MmapLoader : public FileLoader
{
public:
  MmapLoader(ArrayFiles files, int threads)
    : FileLoader(std::move(files), threads)
  {
    for (std::size_t a = 0; a < this->Files.count() && this->Files.tuples() > 0; ++a)
    {
      this->Mappings.push_back(
        std::make_unique<Mapping>(this->Files.array(a), this->Files.file(a)));
    }
  }

  void load(const std::int64_t* ids, std::size_t count, void* const* out) override
  {
    this->Files.range(ids, count, this->Threads);
    this->Counts.UsefulBytes += std::int64_t(count * this->Files.recordBytes());
    constexpr std::size_t share = 1 << 16;
    parallelFor(std::int64_t((count + share - 1) / share), this->Threads,
      [&](std::int64_t i)
      {
        const std::size_t begin = std::size_t(i) * share;
        const std::size_t size = std::min(share, count - begin);
        // Safe: range() has checked that no id is negative.
        const auto* const own = reinterpret_cast<const std::uint64_t*>(ids + begin);
        for (std::size_t a = 0; a < this->Mappings.size(); ++a)
        {
          const std::size_t bytes = this->Files.tupleBytes(a);
          gatherTuples(this->Mappings[a]->tuples(), own, static_cast<char*>(out[a]) + begin * bytes,
            size, bytes);
        }
      });
  }

  const char* name() const override { return "mmap"; }

private:
  std::vector<std::unique_ptr<Mapping>> Mappings;
};

class DirectLoader : public FileLoader
{
public:
  DirectLoader(ArrayFiles files, std::int64_t m, int threads)
    : FileLoader(std::move(files), threads)
    , M(m)
  {
  }

  void load(const std::int64_t* ids, std::size_t count, void* const* out) override
  {
    const IdRange range = this->Files.range(ids, count, this->Threads);
    if (count == 0)
    {
      return;
    }
    this->Counts.UsefulBytes += std::int64_t(count * this->Files.recordBytes());
    const std::int64_t chunkRange = range.High - range.Low + 1;
    if (chunkRange <= this->M)
    {
      this->readSegment(range.Low, chunkRange);
      gatherAll(count, this->Files, this->Buffers, out, this->Threads,
        [ids, low = range.Low](std::size_t i) { return std::uint64_t(ids[i] - low); });
      return;
    }
    const std::size_t segments = std::size_t((range.High - range.Low) / this->M) + 1;
    const Divisor m{ std::uint64_t(this->M) };
    this->Moves.sort(count, segments, this->Threads,
      [this, ids, &m, low = range.Low](std::size_t i)
      {
        const auto relative = std::uint64_t(ids[i] - low);
        const std::uint64_t segment = m.quotient(relative);
        return std::make_pair(segment, std::uint32_t(relative - segment * std::uint64_t(this->M)));
      });
    const std::vector<std::size_t> active = this->Moves.wanted();
    for (const std::size_t segment : active)
    {
      const std::int64_t first = range.Low + std::int64_t(segment) * this->M;
      this->readSegment(first, std::min(this->M, range.High + 1 - first));
      this->Moves.gather(
        segment, segment == active.back(), this->Files, this->Buffers, out, this->Threads);
    }
  }

  const char* name() const override { return "direct"; }

private:
  void readSegment(std::int64_t first, std::int64_t size)
  {
    this->Buffers.resize(this->Files, size);
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      this->Files.read(a, first, size, this->Buffers.data(a), this->Threads, this->Counts);
    }
    ++this->Counts.Passes;
  }

  std::int64_t M;
  TupleBuffers Buffers;
  GroupedMoves Moves;
};

} // namespace

VertexLoader::~VertexLoader() = default;

Loader loaderFromName(const std::string& name)
{
  constexpr std::array<const char*, 4> names = { "auto", "direct", "fine", "mmap" };
  for (std::size_t kind = 0; kind < names.size(); ++kind)
  {
    if (name == names[kind])
    {
      return Loader(kind);
    }
  }
  throw std::invalid_argument(
    "no loader is called '" + name + "'; there are auto, direct, fine and mmap");
}

std::unique_ptr<VertexLoader> makeVertexLoader(
  std::vector<RawArray> arrays, const LoaderOptions& options)
{
  ArrayFiles files(std::move(arrays));
  constexpr std::uint64_t defaultMemoryLimit = std::uint64_t(512) << 20;
  const std::uint64_t limit = options.MemoryLimit > 0 ? options.MemoryLimit : defaultMemoryLimit;
  const std::uint64_t record = std::max<std::size_t>(files.recordBytes(), 1);
  std::int64_t m = options.M > 0 ? options.M : std::int64_t(limit / record);
  // Positions in the buffers are 32-bit numbers.
  constexpr std::int64_t most = std::numeric_limits<std::uint32_t>::max();
  m = std::max<std::int64_t>(std::min({ m, files.tuples(), most }), 1);
  // Mapped files share the memory with the caller's data, so they may take at most half of it.
  const bool fitsWell = std::uint64_t(files.tuples()) <= limit / 2 / record;
  if (options.Kind == Loader::Direct)
  {
    return std::make_unique<DirectLoader>(std::move(files), m, options.Threads);
  }
  if (options.Kind == Loader::Mmap || (options.Kind == Loader::Auto && fitsWell))
  {
    return std::make_unique<MmapLoader>(std::move(files), options.Threads);
  }
  return makeFineLoader(std::move(files), m, options.Threads);
}

} // namespace tipp
