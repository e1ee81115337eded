// SPDX-License-Identifier: BSD-3-Clause
// Direct Load with a fine bitmap: what is active is known for about 1,024 vertices rather than for
// M, so that a chunk whose vertices lie together reads little else; active runs that are near each
// other are read at once, and packed up to M vertices a pass.
#include "Loading/IdGroups.h"
#include "Loading/Loaders.h"
#include "Loading/Runs.h"
#include "Loading/ScatterRange.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

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
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (count > most)
    {
      throw std::length_error("a chunk of 2^32 vertex ids or more is asked for");
    }
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
    RunPlan plan(
      runsOfBlocks(active, block, range.Low, range.High, this->Gap), this->M, block, range.Low);
    // Of each block: where it is packed, and in which group.
    std::vector<std::uint64_t> starts(blocks);
    std::vector<std::uint32_t> groups(blocks);
    for (std::size_t i = 0; i < plan.Runs.size(); ++i)
    {
      const Run& run = plan.Runs[i];
      for (std::int64_t at = 0; at < run.Size; at += block)
      {
        const auto index = std::size_t((run.First + at - range.Low) >> shift);
        starts[index] = plan.Packed[i] + std::uint64_t(at);
        groups[index] = plan.GroupOf[i];
      }
    }
    this->loadPlan(
      { ids, count, range.Low, range.High - range.Low + 1 }, plan, out,
      [&](std::uint64_t id) { return std::size_t(groups[id >> shift]); },
      [&, mask = std::uint64_t(block - 1)](std::uint64_t id)
      { return starts[id >> shift] + (id & mask); });
  }

  void loadSorted(
    const std::int64_t* ids, std::size_t count, const IdRange& range, void* const* out)
  {
    const RunPlan plan(runsOfIds(ids, count, this->Gap), this->M, 1, range.Low);
    const auto runOf = [&](std::uint64_t id)
    {
      const auto after =
        std::upper_bound(plan.Runs.begin(), plan.Runs.end(), range.Low + std::int64_t(id),
          [](std::int64_t value, const Run& run) { return value < run.First; });
      return std::size_t(after - plan.Runs.begin()) - 1;
    };
    this->loadPlan(
      { ids, count, range.Low, range.High - range.Low + 1 }, plan, out,
      [&](std::uint64_t id) { return std::size_t(plan.GroupOf[runOf(id)]); },
      [&](std::uint64_t id)
      {
        const std::size_t run = runOf(id);
        return plan.Packed[run] + (id - std::uint64_t(plan.Runs[run].First - range.Low));
      });
  }

  /// `groupOf` and `place` tell for an id, less the least of all, in which group and where in the
  /// buffers it is.
  template <typename Group, typename Place>
  void loadPlan(const WantedTuples& wanted, const RunPlan& plan, void* const* out,
    const Group& groupOf, const Place& place)
  {
    if (plan.groups() == 1)
    {
      this->readGroup(plan, 0);
      scatterRange(wanted, this->Files, this->Buffers, out, this->Threads, place);
      return;
    }
    const IdGroups sorted =
      groupIds(wanted.Ids, wanted.Count, wanted.First, plan.groups(), this->Threads, groupOf);
    for (std::size_t group = 0; group < plan.groups(); ++group)
    {
      this->readGroup(plan, group);
      scatterPlaces(wanted, sorted.Places.data() + sorted.Starts[group],
        sorted.Starts[group + 1] - sorted.Starts[group], this->Files, this->Buffers, out,
        this->Threads, place);
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
        char* const to = this->Buffers.data(a) + plan.Packed[i] * bytes;
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
};

} // namespace

std::unique_ptr<VertexLoader> makeFineLoader(ArrayFiles files, std::int64_t m, int threads)
{
  return std::make_unique<FineLoader>(std::move(files), m, threads);
}

} // namespace tipp
