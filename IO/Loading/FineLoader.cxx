// SPDX-License-Identifier: BSD-3-Clause
// Direct Load with a fine bitmap: one bit per 1,024 or so vertices instead of one per M, so that a
// chunk whose vertices are close together reads little else. Active runs near each other are read
// at once and packed, up to M vertices a pass. Blocks of a single pass stay in memory for the next
// chunks. If the vertices are few and far apart, each is read by itself and cached. If all vertices
// fit into M, all blocks are kept as soon as the number of bytes read exceeds the size of the
// files.
#include "Loading/ArrayFiles.h"
#include "Loading/BlockCache.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

constexpr int mostShift = 10;

/// Gaps of fewer bytes between two runs are read along with them: that is cheaper than another
/// read.
constexpr std::int64_t gapBytes = 4096;

class FineLoader : public FileLoader
{
public:
  FineLoader(ArrayFiles files, std::int64_t m, int threads)
    : FileLoader(std::move(files), threads)
    , M(m)
    , Gap(gapBytes / std::int64_t(std::max<std::size_t>(this->Files.recordBytes(), 1)))
    , Shift(shiftFor(this->M))
    , Held(this->Shift, this->Files.tuples())
  {
  }

  void load(const std::int64_t* ids, std::size_t count, void* const* out) override
  {
    if (this->loadFromHeld(ids, count, out))
    {
      return;
    }
    const IdRange range = this->Files.range(ids, count, this->Threads);
    if (count == 0)
    {
      return;
    }
    this->Counts.UsefulBytes += std::int64_t(count * this->Files.recordBytes());
    Chunk chunk = { ids, count, range.Low >> this->Shift << this->Shift, range.High, {} };
    const std::size_t blocks = std::size_t((range.High - chunk.Low) >> this->Shift) + 1;
    constexpr std::int64_t sparse = 128; // tuples read per tuple wanted
    // If true, scanning for active blocks costs more than sorting the ids.
    bool isSparse = blocks > count;
    if (!isSparse)
    {
      this->findActiveBlocks(chunk, blocks);
      const std::int64_t active = std::count(chunk.Active.begin(), chunk.Active.end(), char(1))
        << this->Shift;
      isSparse = active > sparse * std::int64_t(count);
    }
    if (isSparse && !this->wantsAll())
    {
      constexpr std::int64_t page = 4096; // the approximate cost, in bytes, of reading one tuple
      this->Spent += std::int64_t(count) * page;
      this->loadSparse(chunk, out);
      return;
    }
    this->findActiveBlocks(chunk, blocks);
    this->loadBlocks(chunk, out);
  }

  const char* name() const override { return "fine"; }

private:
  struct Chunk
  {
    const std::int64_t* Ids;
    std::size_t Count;
    std::int64_t Low; ///< first tuple of the block with the lowest id
    std::int64_t High;
    std::vector<char> Active; ///< per block: whether it has ids
  };

  /// An LRU cache of single tuples. After a miss its slot must be filled; if that fails, the cache
  /// must not be used any more.
  struct TupleCache
  {
    BlockCache Slots;
    TupleBuffers Tuples;
  };

  static int shiftFor(std::int64_t m)
  {
    int shift = 0;
    while (shift < mostShift && (std::int64_t(2) << shift) <= m)
    {
      ++shift;
    }
    return shift;
  }

  /// The usual case: a chunk near the previous ones, most of whose blocks are held. It takes one
  /// pass over the ids. Returns false, having loaded nothing, in other cases.
  bool loadFromHeld(const std::int64_t* ids, std::size_t count, void* const* out)
  {
    constexpr std::size_t few = 1 << 16; // larger chunks use several threads
    if (count > few || this->Held.isEmpty())
    {
      return false;
    }
    makeRoom(this->Sources, count);
    if (!this->Held.find(ids, count, this->Sources.data()))
    {
      return false;
    }
    this->Counts.UsefulBytes += std::int64_t(count * this->Files.recordBytes());
    this->readFound();
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      gatherTuples(this->Buffers.data(a), this->Sources.data(), static_cast<char*>(out[a]), count,
        this->Files.tupleBytes(a));
    }
    return true;
  }

  void readFound()
  {
    const std::vector<TupleRun> runs = this->Held.found();
    try
    {
      std::int64_t to = this->Held.used();
      for (const TupleRun& run : runs)
      {
        this->read(run, to);
        to += this->wholeBlocks(run.Size);
      }
    }
    catch (...)
    {
      this->Held.loseFound();
      throw;
    }
    this->Held.keepFound();
    this->Spent += this->bytesOf(tuplesOf(runs));
    ++this->Counts.Passes;
  }

  /// The number of tuples in the blocks that hold `tuples` tuples.
  std::int64_t wholeBlocks(std::int64_t tuples) const
  {
    return (((tuples - 1) >> this->Shift) + 1) << this->Shift;
  }

  void findActiveBlocks(Chunk& chunk, std::size_t blocks) const
  {
    if (!chunk.Active.empty())
    {
      return;
    }
    constexpr std::int64_t dense = 2; // ids per tuple; then nearly all tuples are wanted
    chunk.Active = std::int64_t(chunk.Count) / dense > chunk.High - chunk.Low
      ? std::vector<char>(blocks, 1)
      : findActive(chunk.Ids, chunk.Count, chunk.Low, blocks, this->Shift, this->Threads);
  }

  std::int64_t bytesOf(std::int64_t tuples) const
  {
    return tuples * std::int64_t(this->Files.recordBytes());
  }

  /// Whether all tuples fit into memory and the bytes read exceed the size of the files: from then
  /// on all blocks that are read are kept.
  bool wantsAll() const
  {
    return this->Files.tuples() <= this->M && this->Spent > this->bytesOf(this->Files.tuples());
  }

  std::vector<TupleRun> runsOf(const Chunk& chunk, const std::vector<char>& wanted) const
  {
    const std::int64_t end = chunk.Low + (std::int64_t(wanted.size()) << this->Shift);
    return runsOfBlocks(wanted, std::int64_t(1) << this->Shift, chunk.Low,
      std::min(end, this->Files.tuples()) - 1, this->Gap);
  }

  void loadBlocks(const Chunk& chunk, void* const* out)
  {
    this->Cache.reset();
    std::vector<TupleRun> runs = this->runsOf(chunk, this->Held.missing(chunk.Active, chunk.Low));
    if (this->Held.used() + tuplesOf(runs) > this->Held.room())
    {
      this->Held.forget();
      runs = this->runsOf(chunk, chunk.Active);
    }
    if (tuplesOf(runs) > this->M)
    {
      this->loadGroups(chunk, runs, out);
      return;
    }
    this->hold(runs);
    gatherAll(chunk.Count, this->Files, this->Buffers, out, this->Threads,
      [positionOf = this->Held.finder(), ids = chunk.Ids](std::size_t i)
      { return positionOf(std::uint64_t(ids[i])); });
  }

  /// The number of tuples in blocks that are kept for the next chunks: neighbouring chunks share
  /// many.
  std::int64_t kept() const
  {
    constexpr std::int64_t enough = 1 << 18; // more would exceed the processor's cache
    return this->wantsAll() ? this->M : std::min(this->M, enough);
  }

  /// Reads runs of blocks to the positions after those held; drops all held blocks first if the
  /// runs do not fit.
  void hold(const std::vector<TupleRun>& runs)
  {
    if (this->Held.isEmpty())
    {
      this->Held.setRoom(std::max({ this->Held.room(), this->kept(), tuplesOf(runs) }));
      this->Buffers.resize(this->Files, this->Held.room());
    }
    this->Spent += this->bytesOf(tuplesOf(runs));
    for (const TupleRun& run : runs)
    {
      this->read(run, this->Held.used());
      this->Held.add(run);
    }
    ++this->Counts.Passes;
  }

  /// For more than M tuples: loads group by group, at most M tuples each. Each id's group and
  /// position are computed first.
  void loadGroups(const Chunk& chunk, const std::vector<TupleRun>& runs, void* const* out)
  {
    const int shift = this->Shift;
    const std::int64_t block = std::int64_t(1) << shift;
    const RunPlan plan(runs, this->M, block, chunk.Low);
    std::vector<std::uint32_t> starts(chunk.Active.size()); // position of each block, and its group
    std::vector<std::uint32_t> groups(chunk.Active.size());
    for (std::size_t i = 0; i < plan.Runs.size(); ++i)
    {
      const TupleRun& run = plan.Runs[i];
      for (std::int64_t at = 0; at < run.Size; at += block)
      {
        const auto index = std::size_t((run.First + at - chunk.Low) >> shift);
        starts[index] = plan.Packed[i] + std::uint32_t(at);
        groups[index] = plan.GroupOf[i];
      }
    }
    this->Moves.sort(chunk.Count, plan.groups(), this->Threads,
      [&starts, &groups, shift, mask = std::uint64_t(block - 1), ids = chunk.Ids, low = chunk.Low](
        std::size_t i)
      {
        const auto relative = std::uint64_t(ids[i] - low);
        return std::make_pair(
          groups[relative >> shift], starts[relative >> shift] + std::uint32_t(relative & mask));
      });
    this->loadMoves(plan, out);
  }

  /// For a few ids far apart: reads single tuples.
  void loadSparse(const Chunk& chunk, void* const* out)
  {
    this->Held.forget();
    const UniqueIds unique(chunk.Ids, chunk.Count);
    if (std::int64_t(unique.Sorted.size()) <= this->cached())
    {
      this->loadCached(unique, chunk, out);
      return;
    }
    const RunPlan plan(runsOfIds(unique.Sorted, this->Gap), this->M, 1, chunk.Low);
    // position of each distinct id, and its group
    std::vector<std::uint32_t> positions(unique.Sorted.size());
    std::vector<std::uint32_t> groups(unique.Sorted.size());
    std::size_t run = 0;
    for (const auto& [id, number] : unique.Sorted)
    {
      while (id >= plan.Runs[run].First + plan.Runs[run].Size)
      {
        ++run;
      }
      positions[number] = plan.Packed[run] + std::uint32_t(id - plan.Runs[run].First);
      groups[number] = plan.GroupOf[run];
    }
    if (plan.groups() == 1)
    {
      this->readGroup(plan, 0);
      gatherAll(chunk.Count, this->Files, this->Buffers, out, this->Threads,
        [&](std::size_t i) { return std::uint64_t(positions[unique.Numbers[i]]); });
      return;
    }
    this->Moves.sort(chunk.Count, plan.groups(), this->Threads,
      [&](std::size_t i)
      {
        const std::uint32_t number = unique.Numbers[i];
        return std::make_pair(groups[number], positions[number]);
      });
    this->loadMoves(plan, out);
  }

  /// The cache's capacity in tuples: half of M, since the tuples that are read take the other half.
  std::int64_t cached() const
  {
    constexpr std::int64_t most = 1 << 16; // still fits in the processor's cache
    return std::min(this->M / 2, most);
  }

  /// Neighbouring chunks share vertices, so the tuples of the last chunks are kept.
  void loadCached(const UniqueIds& unique, const Chunk& chunk, void* const* out)
  {
    if (!this->Cache)
    {
      this->Buffers = TupleBuffers(); // both together would exceed M
      this->Held.setRoom(0);
      this->Cache =
        std::make_unique<TupleCache>(TupleCache{ BlockCache(std::uint32_t(this->cached())), {} });
      this->Cache->Tuples.resize(this->Files, this->cached());
    }
    std::vector<std::uint32_t> slots(unique.Sorted.size());      // slot of each distinct id
    std::vector<std::pair<std::int64_t, std::uint32_t>> missing; // ids and their slots
    for (const auto& [id, number] : unique.Sorted)
    {
      const BlockCache::UsedSlot found = this->Cache->Slots.use(std::uint64_t(id));
      slots[number] = found.Slot;
      if (found.Miss)
      {
        missing.emplace_back(id, found.Slot);
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
    gatherAll(chunk.Count, this->Files, this->Cache->Tuples, out, this->Threads,
      [&](std::size_t i) { return std::uint64_t(slots[unique.Numbers[i]]); });
  }

  void fillCache(
    const std::vector<std::pair<std::int64_t, std::uint32_t>>& missing, std::int64_t low)
  {
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
        const TupleRun& read = plan.Runs[run];
        for (; next != missing.end() && next->first < read.First + read.Size; ++next)
        {
          const std::size_t index = plan.Packed[run] + std::size_t(next->first - read.First);
          for (std::size_t a = 0; a < this->Files.count(); ++a)
          {
            const std::size_t bytes = this->Files.tupleBytes(a);
            std::memcpy(this->Cache->Tuples.data(a) + next->second * bytes,
              this->Buffers.data(a) + index * bytes, bytes);
          }
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
    for (std::size_t i = begin; i < end; ++i)
    {
      this->read(plan.Runs[i], plan.Packed[i]);
    }
    ++this->Counts.Passes;
  }

  void read(const TupleRun& run, std::int64_t to)
  {
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      this->Files.read(a, run.First, run.Size,
        this->Buffers.data(a) + std::size_t(to) * this->Files.tupleBytes(a), this->Threads,
        this->Counts);
    }
  }

  static std::int64_t tuplesOf(const std::vector<TupleRun>& runs)
  {
    return std::accumulate(runs.begin(), runs.end(), std::int64_t(0),
      [](std::int64_t sum, const TupleRun& run) { return sum + run.Size; });
  }

  std::int64_t M;
  std::int64_t Gap; ///< largest gap to read over, in tuples
  int Shift;        ///< a block is 2^Shift tuples
  HeldBlocks Held;  ///< blocks in the buffers
  TupleBuffers Buffers;
  std::int64_t Spent = 0;            ///< approximate number of bytes read
  Buffer<std::uint32_t> Sources;     ///< position of each of the chunk's tuples in the buffers
  std::unique_ptr<TupleCache> Cache; ///< created for the first sparse chunk
  GroupedMoves Moves;
};

} // namespace

std::unique_ptr<VertexLoader> makeFineLoader(ArrayFiles files, std::int64_t m, int threads)
{
  return std::make_unique<FineLoader>(std::move(files), m, threads);
}

} // namespace tipp
