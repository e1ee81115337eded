// SPDX-License-Identifier: BSD-3-Clause
// Direct Load with a fine bitmap: what is active is known for about 1,024 vertices rather than for
// M, so that a chunk whose vertices lie together reads little else; active runs that are near each
// other are read at once, and packed up to M vertices a pass. Of vertices that are few and far
// apart each is read by itself, and kept for the next chunks. Where all vertices fit into M, what
// is read stays in memory from when as much has been read as there is.
#include "Loading/ActiveSegments.h"
#include "Loading/GatherAll.h"
#include "Loading/GroupedMoves.h"
#include "Loading/Loaders.h"
#include "Loading/Runs.h"
#include "Loading/TupleCache.h"
#include "Loading/UniqueIds.h"

#include <algorithm>
#include <limits>
#include <utility>

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
    // Places in the buffers are numbers of 32 bits.
    , M(std::min<std::int64_t>(m, std::numeric_limits<std::uint32_t>::max()))
    , Threads(threads)
    , Gap(gapBytes / std::int64_t(std::max<std::size_t>(this->Files.recordBytes(), 1)))
  {
    while (this->Shift < mostShift && (std::int64_t(2) << this->Shift) <= this->M)
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
    Chunk chunk = { ids, count, range.Low >> this->Shift << this->Shift, range.High, {} };
    const std::size_t blocks = std::size_t((range.High - chunk.Low) >> this->Shift) + 1;
    constexpr std::int64_t sparse = 128; // tuples that are read along with each that is wanted
    bool isSparse = blocks > count;      // then to look for active blocks is more work than to sort
    std::int64_t pages = std::int64_t(count);
    if (!isSparse)
    {
      this->findActiveBlocks(chunk, blocks);
      const std::int64_t active = std::count(chunk.Active.begin(), chunk.Active.end(), char(1))
        << this->Shift;
      isSparse = active > sparse * std::int64_t(count);
      pages = isSparse ? pages : this->pagesOf(active);
    }
    if (this->keepsAll(pages, isSparse))
    {
      this->findActiveBlocks(chunk, blocks);
      this->loadWhole(chunk, out);
    }
    else if (isSparse)
    {
      this->loadSparse(chunk, out);
    }
    else
    {
      this->loadBlocks(chunk, out);
    }
  }

  const LoadCounters& counters() const override { return this->Counts; }
  Loader kind() const override { return Loader::Fine; }

private:
  struct Chunk
  {
    const std::int64_t* Ids;
    std::size_t Count;
    std::int64_t Low; ///< where the block of the lowest id begins
    std::int64_t High;
    std::vector<char> Active; ///< of each block: has ids, and has not been read
  };

  bool fitsWhole() const { return this->Files.tuples() <= this->M; }

  void findActiveBlocks(Chunk& chunk, std::size_t blocks) const
  {
    if (!chunk.Active.empty())
    {
      return;
    }
    const auto blockOf = [shift = this->Shift](std::uint64_t id) { return id >> shift; };
    constexpr std::int64_t dense = 2; // ids for each tuple, of which hardly one is not wanted
    chunk.Active = std::int64_t(chunk.Count) / dense > chunk.High - chunk.Low
      ? std::vector<char>(blocks, 1)
      : findActive(chunk.Ids, chunk.Count, chunk.Low, blocks, this->Threads, blockOf);
    if (!this->WasRead.empty())
    {
      const char* const wasRead = this->WasRead.data() + (chunk.Low >> this->Shift);
      for (std::size_t block = 0; block < blocks; ++block)
      {
        chunk.Active[block] &= char(wasRead[block] ^ 1);
      }
    }
  }

  std::int64_t pagesOf(std::int64_t tuples) const
  {
    constexpr std::int64_t page = 4096;
    return tuples * std::int64_t(this->Files.recordBytes()) / page;
  }

  /// Whether what is read shall stay: if all fits, and if single tuples are wanted, from when as
  /// much has been read as there is.
  bool keepsAll(std::int64_t pages, bool isSparse)
  {
    this->PagesRead += pages;
    return this->fitsWhole() &&
      (!isSparse || this->PagesRead > this->pagesOf(this->Files.tuples()));
  }

  /// Tuples are in the buffers where they are in the files.
  void loadWhole(const Chunk& chunk, void* const* out)
  {
    const std::int64_t block = std::int64_t(1) << this->Shift;
    this->Buffers.resize(this->Files, this->Files.tuples());
    this->WasRead.resize(std::size_t((this->Files.tuples() - 1) >> this->Shift) + 1, 0);
    const std::int64_t end = std::min(
      chunk.Low + (std::int64_t(chunk.Active.size()) << this->Shift), this->Files.tuples());
    for (const Run& run : runsOfBlocks(chunk.Active, block, chunk.Low, end - 1, 1))
    {
      for (std::size_t a = 0; a < this->Files.count(); ++a)
      {
        char* const to = this->Buffers.data(a) + std::size_t(run.First) * this->Files.tupleBytes(a);
        this->Files.read(a, run.First, run.Size, to, this->Threads, this->Counts);
      }
      const auto first = this->WasRead.begin() + (run.First >> this->Shift);
      std::fill(first, first + ((run.Size - 1) >> this->Shift) + 1, char(1));
    }
    ++this->Counts.Passes;
    gatherAll(chunk.Count, this->Files, this->Buffers, out, this->Threads,
      [ids = chunk.Ids](std::size_t i) { return std::uint64_t(ids[i]); });
  }

  void loadBlocks(const Chunk& chunk, void* const* out)
  {
    const int shift = this->Shift;
    const std::int64_t block = std::int64_t(1) << shift;
    const std::size_t blocks = chunk.Active.size();
    const RunPlan plan(runsOfBlocks(chunk.Active, block, chunk.Low, chunk.High, this->Gap), this->M,
      block, chunk.Low);
    // Where each block is packed, and in which group.
    std::vector<std::uint32_t> starts(blocks);
    std::vector<std::uint32_t> groups(blocks);
    for (std::size_t i = 0; i < plan.Runs.size(); ++i)
    {
      const Run& run = plan.Runs[i];
      for (std::int64_t at = 0; at < run.Size; at += block)
      {
        const auto index = std::size_t((run.First + at - chunk.Low) >> shift);
        starts[index] = plan.Packed[i] + std::uint32_t(at);
        groups[index] = plan.GroupOf[i];
      }
    }
    const auto place = [&starts, shift, mask = std::uint64_t(block - 1)](std::uint64_t id)
    { return starts[id >> shift] + (id & mask); };
    if (plan.groups() == 1)
    {
      this->readGroup(plan, 0);
      gatherAll(chunk.Count, this->Files, this->Buffers, out, this->Threads,
        [&place, ids = chunk.Ids, low = chunk.Low](std::size_t i)
        { return place(std::uint64_t(ids[i] - low)); });
      return;
    }
    this->Moves.sort(chunk.Count, plan.groups(), this->Threads,
      [&place, &groups, shift, ids = chunk.Ids, low = chunk.Low](std::size_t i)
      {
        const auto relative = std::uint64_t(ids[i] - low);
        return std::make_pair(groups[relative >> shift], std::uint32_t(place(relative)));
      });
    this->loadMoves(plan, out);
  }

  /// Few ids far apart: single tuples are read.
  void loadSparse(const Chunk& chunk, void* const* out)
  {
    const UniqueIds unique(chunk.Ids, chunk.Count);
    if (std::int64_t(unique.Sorted.size()) <= this->cached())
    {
      this->loadCached(unique, chunk, out);
      return;
    }
    const RunPlan plan(runsOfIds(unique.Sorted, this->Gap), this->M, 1, chunk.Low);
    std::vector<std::uint32_t> places(unique.Sorted.size()); // of each number, and its group
    std::vector<std::uint32_t> groups(unique.Sorted.size());
    std::size_t run = 0;
    for (const auto& [id, number] : unique.Sorted)
    {
      while (id >= plan.Runs[run].First + plan.Runs[run].Size)
      {
        ++run;
      }
      places[number] = plan.Packed[run] + std::uint32_t(id - plan.Runs[run].First);
      groups[number] = plan.GroupOf[run];
    }
    if (plan.groups() == 1)
    {
      this->readGroup(plan, 0);
      gatherAll(chunk.Count, this->Files, this->Buffers, out, this->Threads,
        [&](std::size_t i) { return std::uint64_t(places[unique.Numbers[i]]); });
      return;
    }
    this->Moves.sort(chunk.Count, plan.groups(), this->Threads,
      [&](std::size_t i)
      {
        const std::uint32_t number = unique.Numbers[i];
        return std::make_pair(groups[number], places[number]);
      });
    this->loadMoves(plan, out);
  }

  /// Tuples that the cache holds: half of M, the rest is for what is read.
  std::int64_t cached() const
  {
    constexpr std::int64_t most = 1 << 16; // few enough for the processor's cache
    return std::min(this->M / 2, most);
  }

  /// Neighbouring chunks share vertices: so those of the last chunks stay.
  void loadCached(const UniqueIds& unique, const Chunk& chunk, void* const* out)
  {
    if (!this->Cache)
    {
      this->Cache = std::make_unique<TupleCache>(this->Files, std::uint32_t(this->cached()));
    }
    std::vector<std::uint32_t> slots(unique.Sorted.size());      // of each number
    std::vector<std::pair<std::int64_t, std::uint32_t>> missing; // and their slots
    for (const auto& [id, number] : unique.Sorted)
    {
      const BlockCache::Place place = this->Cache->use(id);
      slots[number] = place.Slot;
      if (place.Miss)
      {
        missing.emplace_back(id, place.Slot);
      }
    }
    try
    {
      this->fillCache(missing, chunk.Low);
    }
    catch (...)
    {
      this->Cache.reset();
      throw;
    }
    gatherAll(chunk.Count, this->Files, this->Cache->tuples(), out, this->Threads,
      [&](std::size_t i) { return std::uint64_t(slots[unique.Numbers[i]]); });
  }

  void fillCache(
    const std::vector<std::pair<std::int64_t, std::uint32_t>>& missing, std::int64_t low)
  {
    this->Counts.CacheMisses += std::int64_t(missing.size());
    if (missing.empty())
    {
      return;
    }
    const RunPlan plan(runsOfIds(missing, this->Gap), this->M - this->cached(), 1, low);
    std::size_t run = 0;
    auto next = missing.begin();
    for (std::size_t group = 0; group < plan.groups(); ++group)
    {
      this->readGroup(plan, group);
      for (; run < plan.Starts[group + 1]; ++run)
      {
        const Run& read = plan.Runs[run];
        for (; next != missing.end() && next->first < read.First + read.Size; ++next)
        {
          this->Cache->fill(next->second, this->Files, this->Buffers,
            plan.Packed[run] + std::size_t(next->first - read.First));
        }
      }
    }
  }

  void loadMoves(const RunPlan& plan, void* const* out)
  {
    for (std::size_t group = 0; group < plan.groups(); ++group)
    {
      this->readGroup(plan, group);
      this->Moves.gather(
        group, group + 1 == plan.groups(), this->Files, this->Buffers, out, this->Threads);
    }
  }

  void readGroup(const RunPlan& plan, std::size_t group)
  {
    const std::size_t begin = plan.Starts[group];
    const std::size_t end = plan.Starts[group + 1];
    this->Buffers.resize(this->Files, std::int64_t(plan.Packed[end - 1]) + plan.Runs[end - 1].Size);
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      const std::size_t bytes = this->Files.tupleBytes(a);
      for (std::size_t i = begin; i < end; ++i)
      {
        const Run& run = plan.Runs[i];
        char* const to = this->Buffers.data(a) + std::size_t(plan.Packed[i]) * bytes;
        this->Files.read(a, run.First, run.Size, to, this->Threads, this->Counts);
      }
    }
    ++this->Counts.Passes;
  }

  ArrayFiles Files;
  std::int64_t M;
  int Threads;
  std::int64_t Gap; ///< in tuples
  int Shift = 0;    ///< a block is 2^Shift tuples
  LoadCounters Counts;
  TupleBuffers Buffers;
  std::vector<char> WasRead;         ///< of each block, where all tuples fit
  std::int64_t PagesRead = 0;        ///< about, and a page for each tuple read by itself
  std::unique_ptr<TupleCache> Cache; ///< once there was a chunk of few ids far apart
  GroupedMoves Moves;
};

} // namespace

std::unique_ptr<VertexLoader> makeFineLoader(ArrayFiles files, std::int64_t m, int threads)
{
  return std::make_unique<FineLoader>(std::move(files), m, threads);
}

} // namespace tipp
