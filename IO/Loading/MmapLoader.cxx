// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Loading/ArrayFiles.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

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

class MmapLoader : public VertexLoader
{
public:
  MmapLoader(ArrayFiles files, int threads)
    : Files(std::move(files))
    , Threads(threads)
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

  const LoadCounters& counters() const override { return this->Counts; }
  Loader kind() const override { return Loader::Mmap; }

private:
  ArrayFiles Files;
  int Threads;
  LoadCounters Counts;
  std::vector<std::unique_ptr<Mapping>> Mappings;
};

} // namespace

std::unique_ptr<VertexLoader> makeMmapLoader(ArrayFiles files, int threads)
{
  return std::make_unique<MmapLoader>(std::move(files), threads);
}

} // namespace tipp
