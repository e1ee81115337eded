// SPDX-License-Identifier: BSD-3-Clause
// Direct Load with a fine bitmap: what is active is known for about 1,024 vertices rather than for
// M, so that a chunk whose vertices lie together reads little else; active runs that are near each
// other are read at once, and packed up to M vertices a pass.
#include "Loading/Loaders.h"
#include "Loading/Runs.h"
#include "Loading/ScatterRange.h"

#include <algorithm>

namespace tipp
{
namespace
{

constexpr int mostShift = 10;

/// Bytes between two runs that are read along sooner than another read is begun.
constexpr std::int64_t gapBytes = 4096;

class FineLoader : public VertexLoader
{
public:
  FineLoader(ArrayFiles files, std::int64_t m, int threads)
    : Files(std::move(files))
    , M(m)
    , Threads(threads)
    , Gap(gapBytes / std::int64_t(std::max<std::size_t>(this->Files.recordBytes(), 1)))
  {
    while (this->Shift < mostShift && (std::int64_t(2) << this->Shift) <= m)
    {
      ++this->Shift;
    }
  }

  void load(const std::int64_t* ids, std::size_t count, void* const* out) override
  {
    const IdRange range = this->Files.range(ids, count, this->Threads);
    if (count == 0)
    {
      return;
    }
    this->Counts.UsefulBytes += std::int64_t(count * this->Files.recordBytes());
    // Few ids far apart are sorted: a bit for each block would be more work, and blocks too coarse.
    constexpr std::int64_t sparse = 128;
    const bool sorted = std::int64_t(count) < (range.High - range.Low) / sparse;
    if (sorted)
    {
      this->loadSorted(ids, count, range, out);
    }
    else
    {
      this->loadBlocks(ids, count, range, out);
    }
  }

  const LoadCounters& counters() const override { return this->Counts; }
  Loader kind() const override { return Loader::Fine; }

private:
  void loadBlocks(
    const std::int64_t* ids, std::size_t count, const IdRange& range, void* const* out)
  {
    const int shift = this->Shift;
    const std::int64_t block = std::int64_t(1) << shift;
    const std::size_t blocks = std::size_t((range.High - range.Low) >> shift) + 1;
    const std::vector<char> active = markActive(ids, count, range.Low, blocks, this->Threads,
      [shift](std::uint64_t id) { return id >> shift; });
    std::vector<Run> runs = runsOfBlocks(active, block, range.Low, range.High, this->Gap);
    const std::vector<std::size_t> groups = groupRuns(runs, this->M, block, range.Low);
    // Where each block's first tuple is packed.
    std::vector<std::uint64_t> starts(blocks);
    for (std::size_t group = 0; group + 1 < groups.size(); ++group)
    {
      const Run* const begin = runs.data() + groups[group];
      const Run* const end = runs.data() + groups[group + 1];
      const std::int64_t skipped = (begin->First - range.Low) >> shift;
      std::int64_t packed = 0;
      for (const Run* run = begin; run != end; ++run)
      {
        for (std::int64_t at = 0; at < run->Size; at += block)
        {
          const std::int64_t index = ((run->First + at - range.Low) >> shift) - skipped;
          starts[std::size_t(index)] = std::uint64_t(packed + at);
        }
        packed += run->Size;
      }
      this->loadGroup({ ids, count, begin->First, end[-1].First + end[-1].Size - begin->First },
        begin, end, out,
        [&starts, shift, mask = std::uint64_t(block - 1)](std::uint64_t id)
        { return starts[id >> shift] + (id & mask); });
    }
  }

  void loadSorted(
    const std::int64_t* ids, std::size_t count, const IdRange& range, void* const* out)
  {
    std::vector<Run> runs = runsOfIds(ids, count, this->Gap);
    const std::vector<std::size_t> groups = groupRuns(runs, this->M, 1, range.Low);
    std::vector<std::uint64_t> firsts;
    std::vector<std::uint64_t> starts;
    for (std::size_t group = 0; group + 1 < groups.size(); ++group)
    {
      const Run* const begin = runs.data() + groups[group];
      const Run* const end = runs.data() + groups[group + 1];
      firsts.clear();
      starts.clear();
      std::uint64_t packed = 0;
      for (const Run* run = begin; run != end; ++run)
      {
        firsts.push_back(std::uint64_t(run->First - begin->First));
        starts.push_back(packed);
        packed += std::uint64_t(run->Size);
      }
      this->loadGroup({ ids, count, begin->First, end[-1].First + end[-1].Size - begin->First },
        begin, end, out,
        [&firsts, &starts](std::uint64_t id)
        {
          const auto run = std::upper_bound(firsts.begin(), firsts.end(), id) - 1;
          return starts[std::size_t(run - firsts.begin())] + (id - *run);
        });
    }
  }

  template <typename Place>
  void loadGroup(const WantedTuples& wanted, const Run* begin, const Run* end, void* const* out,
    const Place& place)
  {
    std::int64_t packed = 0;
    for (const Run* run = begin; run != end; ++run)
    {
      packed += run->Size;
    }
    this->Buffers.resize(this->Files, packed);
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      std::size_t at = 0;
      for (const Run* run = begin; run != end; ++run)
      {
        this->Files.read(a, run->First, run->Size, this->Buffers.data(a) + at, this->Counts);
        at += std::size_t(run->Size) * this->Files.tupleBytes(a);
      }
    }
    ++this->Counts.Passes;
    scatterRange(wanted, this->Files, this->Buffers, out, this->Threads, place);
  }

  ArrayFiles Files;
  std::int64_t M;
  int Threads;
  std::int64_t Gap; ///< in tuples
  int Shift = 0;    ///< a block is 2^Shift tuples
  LoadCounters Counts;
  TupleBuffers Buffers;
};

} // namespace

std::unique_ptr<VertexLoader> makeFineLoader(ArrayFiles files, std::int64_t m, int threads)
{
  return std::make_unique<FineLoader>(std::move(files), m, threads);
}

} // namespace tipp
