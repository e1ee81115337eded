// SPDX-License-Identifier: BSD-3-Clause
// Direct Load with a fine bitmap: what is active is known for about 1,024 vertices rather than for
// M, so that a chunk whose vertices lie together reads little else; active runs that are near each
// other are read at once, and packed up to M vertices a pass.
#include "Loading/Loaders.h"
#include "Loading/Runs.h"
#include "Loading/ScatterRange.h"
#include "Loading/SegmentCounts.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
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
    requireCountable(count);
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
    const SegmentCounts counts = countSegments(ids, count, range.Low, blocks, this->Threads,
      [shift](std::uint64_t id) { return id >> shift; });
    const RunPlan plan(runsOfBlocks(counts.active(), block, range.Low, range.High, this->Gap),
      this->M, block, range.Low);
    // Where each block is packed, and in which group.
    std::vector<std::uint32_t> starts(blocks);
    std::vector<std::uint32_t> groups(blocks);
    for (std::size_t i = 0; i < plan.Runs.size(); ++i)
    {
      const Run& run = plan.Runs[i];
      for (std::int64_t at = 0; at < run.Size; at += block)
      {
        const auto index = std::size_t((run.First + at - range.Low) >> shift);
        starts[index] = plan.Packed[i] + std::uint32_t(at);
        groups[index] = plan.GroupOf[i];
      }
    }
    const auto place = [&starts, shift, mask = std::uint64_t(block - 1)](std::uint64_t id)
    { return starts[id >> shift] + (id & mask); };
    if (plan.groups() == 1)
    {
      this->readGroup(plan, 0);
      scatterRange({ ids, count, range.Low, range.High - range.Low + 1 }, this->Files,
        this->Buffers, out, this->Threads, place);
      return;
    }
    this->sortMoves(ids, counts, groups, plan.groups(),
      [&place, &groups, shift, low = range.Low](std::int64_t id)
      {
        const auto relative = std::uint64_t(id - low);
        return std::make_pair(groups[relative >> shift], std::uint32_t(place(relative)));
      });
    this->loadMoves(plan, out);
  }

  /// Fills Moves, group by group: a counting sort. where(id) gives an id's group and its place in
  /// the buffers.
  template <typename Where>
  void sortMoves(const std::int64_t* ids, const SegmentCounts& counts,
    const std::vector<std::uint32_t>& groupOf, std::size_t groups, const Where& where)
  {
    std::vector<std::vector<std::size_t>> next(counts.shares());
    for (std::size_t share = 0; share < counts.shares(); ++share)
    {
      next[share].assign(groups, 0);
      for (std::size_t block = 0; block < groupOf.size(); ++block)
      {
        next[share][groupOf[block]] += counts.Shares[share][block];
      }
    }
    this->MoveStarts.clear();
    std::size_t at = 0;
    for (std::size_t group = 0; group < groups; ++group)
    {
      this->MoveStarts.push_back(at);
      for (std::vector<std::size_t>& own : next)
      {
        at += std::exchange(own[group], at);
      }
    }
    this->MoveStarts.push_back(at);
    this->reserveMoves(at);
    parallelFor(std::int64_t(counts.shares()), this->Threads,
      [&](std::int64_t share)
      {
        std::vector<std::size_t>& own = next[std::size_t(share)];
        const std::size_t end = counts.ShareStarts[std::size_t(share) + 1];
        for (std::size_t i = counts.ShareStarts[std::size_t(share)]; i < end; ++i)
        {
          const auto [group, source] = where(ids[i]);
          this->Moves[own[group]++] = { source, std::uint32_t(i) };
        }
      });
  }

  void loadSorted(
    const std::int64_t* ids, std::size_t count, const IdRange& range, void* const* out)
  {
    std::vector<std::pair<std::int64_t, std::uint32_t>> sorted(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      sorted[i] = { ids[i], std::uint32_t(i) };
    }
    std::sort(sorted.begin(), sorted.end());
    const RunPlan plan(runsOfIds(sorted, this->Gap), this->M, 1, range.Low);
    this->reserveMoves(count);
    this->MoveStarts.clear();
    std::size_t i = 0;
    for (std::size_t run = 0; run < plan.Runs.size(); ++run)
    {
      if (plan.GroupOf[run] == this->MoveStarts.size())
      {
        this->MoveStarts.push_back(i);
      }
      const std::int64_t first = plan.Runs[run].First;
      for (; i < count && sorted[i].first < first + plan.Runs[run].Size; ++i)
      {
        const auto inside = std::uint32_t(sorted[i].first - first);
        this->Moves[i] = { plan.Packed[run] + inside, sorted[i].second };
      }
    }
    this->MoveStarts.push_back(count);
    this->loadMoves(plan, out);
  }

  void loadMoves(const RunPlan& plan, void* const* out)
  {
    for (std::size_t group = 0; group < plan.groups(); ++group)
    {
      this->readGroup(plan, group);
      scatterMoves(this->Moves.get() + this->MoveStarts[group],
        this->MoveStarts[group + 1] - this->MoveStarts[group], this->Files, this->Buffers, out,
        this->Threads);
    }
  }

  /// Without setting them: all are written before they are read.
  void reserveMoves(std::size_t count)
  {
    if (count > this->MoveRoom)
    {
      this->Moves.reset(new Move[count]);
      this->MoveRoom = count;
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
        this->Files.read(a, run.First, run.Size, to, this->Counts);
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
  std::unique_ptr<Move[]> Moves; ///< of the chunk, sorted by group
  std::size_t MoveRoom = 0;
  std::vector<std::size_t> MoveStarts; ///< of the groups, and the number of moves
};

} // namespace

std::unique_ptr<VertexLoader> makeFineLoader(ArrayFiles files, std::int64_t m, int threads)
{
  return std::make_unique<FineLoader>(std::move(files), m, threads);
}

} // namespace tipp
