// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Interpolate.h"

#include "Parallel/Stopwatch.h"
#include "Resample/BorderClaims.h"
#include "Resample/CellVisitor.h"
#include "Resample/FillBlock.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tipp
{
namespace
{

/// Fills the samples of claims [first, last) that do not need interpolation; claim i is sample i +
/// shift of the whole lattice.
void fillRest(const std::vector<Attribute>& attributes, const std::int32_t* claims,
  std::int64_t first, std::int64_t last, std::int64_t shift, const InterpolationOptions& options)
{
  const auto claimed = [claims, shift](std::int64_t i) { return claims[i - shift] >= 0; };
  const std::int64_t begin = first + shift;
  const std::int64_t end = last + shift;
  for (const Attribute& attribute : attributes)
  {
    if (options.FillUnclaimed)
    {
      fillNull(attribute, begin, end, [&](std::int64_t i) { return !claimed(i); });
    }
    if (!attribute.Values)
    {
      fillNull(attribute, begin, end, claimed);
    }
  }
  for (std::int64_t i = options.Valid ? begin : end; i < end; ++i)
  {
    const bool is = claimed(i);
    options.Valid[i] = is || options.FillUnclaimed ? is : options.Valid[i];
  }
}

/// Calls work(cell, row, begin, count) for runs of samples that one cell claims, within the
/// window's samples [begin, end). `row` counts samples in the whole lattice.
template <typename Access, typename Work>
void forCellRuns(const Access& access, const LatticeAxes& axes, const SampleWindow& window,
  const std::int32_t* claims, std::int64_t begin, std::int64_t end, const Work& work)
{
  constexpr std::int64_t ahead = 16;
  const int width = axes.U.size();
  for (std::int64_t i = begin; i < end;)
  {
    const std::int64_t line = i / width;
    const std::int64_t rowBegin = line * width;
    const SampleRow row{ window.indexOf(line), int(line % axes.V.size()),
      int(line / axes.V.size()) };
    const std::int64_t rowEnd = std::min(end, rowBegin + width);
    while (i < rowEnd)
    {
      const std::int32_t cell = claims[i];
      const std::int64_t first = i;
      while (i < rowEnd && claims[i] == cell)
      {
        ++i;
      }
      if (cell >= 0)
      {
        const std::int64_t soon = std::min(i + ahead, end - 1);
        const std::int64_t later = std::min(i + 2 * ahead, end - 1);
        claims[soon] >= 0 ? access.prefetch(claims[soon]) : void();
        __builtin_prefetch(access.ids(std::max(claims[later], 0)));
        work(cell, row, int(first - rowBegin), int(i - first));
      }
    }
  }
}

} // namespace

bool interpolate(const SimplexMesh& mesh, const SampleWindow& window, const std::int32_t* claims,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options)
{
  const LatticeAxes axes(mesh, window.lattice());
  bool completed = false;
  withAccess(mesh,
    [&](const auto& access)
    {
      using Block = SampleBlock<std::decay_t<decltype(access)>>;
      std::vector<Block> blocks(std::size_t(options.Threads), Block(mesh, axes));
      completed = forChunks(axes.samples(), Block::Capacity, options.Threads, options.Progress,
        [&](std::int64_t begin, std::int64_t end, int thread)
        {
          Block& block = blocks[std::size_t(thread)];
          block.clear();
          forCellRuns(access, axes, window, claims, begin, end,
            [&](std::int32_t cell, const SampleRow& row, int first, int count)
            { block.add(cell, row, first, count); });
          fillBlock(block, attributes, options.Parents);
          window.forRuns(begin, end,
            [&](std::int64_t first, std::int64_t last, std::int64_t shift)
            { fillRest(attributes, claims, first, last, shift, options); });
        });
    });
  return completed;
}

namespace
{

/// Calls work(first, last) for each run of zeros in bytes [begin, end), which are all 0 or 1.
template <typename Work>
void forZeros(const unsigned char* bytes, std::int64_t begin, std::int64_t end, const Work& work)
{
  const auto find = [&](int byte, std::int64_t from)
  {
    const void* const found = std::memchr(bytes + from, byte, std::size_t(end - from));
    return found ? static_cast<const unsigned char*>(found) - bytes : end;
  };
  for (std::int64_t first = find(0, begin); first < end;)
  {
    const std::int64_t last = find(1, first);
    work(first, last);
    first = find(0, last);
  }
}

/// A thread's sink, which fills samples as cells claim them.
template <typename Access>
class FillingWalk : public TouchingWalk<FillingWalk<Access>>
{
public:
  FillingWalk(const SimplexMesh& mesh, const LatticeAxes& axes,
    const std::vector<Attribute>& attributes, const InterpolationOptions& options)
    : Attributes(attributes)
    , Options(options)
    , Block(mesh, axes)
  {
  }

  [[gnu::always_inline]] void claim(const SampleRow& row, int begin, int count, std::int32_t cell)
  {
    while (count > this->Block.room())
    {
      const int part = this->Block.room();
      this->Block.add(cell, row, begin, part);
      this->flush();
      begin += part;
      count -= part;
    }
    this->Block.add(cell, row, begin, count);
  }

  void endChunk()
  {
    this->flush();
    TouchingWalk<FillingWalk>::endChunk();
  }

  [[gnu::noinline]] void flush()
  {
    this->Claimed += this->Block.size();
    unsigned char* const valid = this->Options.Valid;
    const std::int64_t* const indices = this->Block.indices();
    const int size = this->Block.size();
    for (int j = 0; j < size; ++j)
    {
      // An ordinary store; but cells that overlap may be in two threads at once.
      __atomic_store_n(valid + indices[j], 1, __ATOMIC_RELAXED);
    }
    fillBlock(this->Block, this->Attributes, this->Options.Parents);
    this->Block.clear();
  }

  bool isClaimed(std::int64_t sample) const
  {
    return __atomic_load_n(this->Options.Valid + sample, __ATOMIC_RELAXED) != 0;
  }

private:
  const std::vector<Attribute>& Attributes;
  const InterpolationOptions& Options;
  SampleBlock<Access> Block;
};

/// One run of sampleDirectly(), typed for the mesh.
template <typename Access>
class DirectSampler
{
public:
  using Walk = FillingWalk<Access>;

  DirectSampler(const SimplexMesh& mesh, const LatticeAxes& axes,
    const std::vector<Attribute>& attributes, const InterpolationOptions& options)
    : Mesh(mesh)
    , Axes(axes)
    , Attributes(attributes)
    , Options(options)
    , Walks(std::size_t(options.Threads), Walk(mesh, axes, attributes, options))
  {
  }

  /// For the arguments see sampleRest().
  DirectResult run(std::int64_t claimed, std::vector<BorderSample>* border)
  {
    this->Result.Aborted =
      !CellVisitor<Access, Walk>(this->Mesh, this->Axes, this->Walks).run(this->Options.Progress);
    std::vector<Touch> touches = joinWalks(this->Walks, this->Result.Statistics, claimed);
    const Stopwatch watch;
    if (!this->Result.Aborted)
    {
      this->Result.Overlapping = this->finishSamples() != claimed;
    }
    if (!this->Result.Aborted && !this->Result.Overlapping)
    {
      this->fillBorder(std::move(touches), border);
    }
    this->Result.FinishSeconds = watch.seconds();
    return this->Result;
  }

private:
  /// Sets the samples outside of all cells to their null values. Returns the number of samples
  /// inside.
  std::int64_t finishSamples()
  {
    return sumOfChunks(this->Axes.samples(), 1 << 16, this->Options.Threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        const auto always = [](std::int64_t) { return true; };
        std::int64_t inside = end - begin;
        forZeros(this->Options.Valid, begin, end,
          [&](std::int64_t first, std::int64_t last)
          {
            inside -= last - first;
            for (const Attribute& attribute : this->Attributes)
            {
              attribute.Values ? fillNull(attribute, first, last, always) : void();
            }
          });
        for (const Attribute& attribute : this->Attributes)
        {
          attribute.Values ? void() : fillNull(attribute, begin, end, always);
        }
        return inside;
      });
  }

  void fillBorder(std::vector<Touch> touches, std::vector<BorderSample>* border)
  {
    const std::int64_t width = this->Axes.U.size();
    const std::int64_t height = this->Axes.V.size();
    const std::vector<BorderClaim> claims =
      borderClaims(this->Mesh, this->Axes, std::move(touches), this->Options.Threads);
    forChunks(std::int64_t(claims.size()), 1 << 10, this->Options.Threads, {},
      [&](std::int64_t begin, std::int64_t end, int thread)
      {
        Walk& walk = this->Walks[std::size_t(thread)];
        for (std::int64_t i = begin; i < end; ++i)
        {
          const BorderClaim& claim = claims[std::size_t(i)];
          const std::int64_t line = claim.Sample / width;
          const SampleRow row{ line * width, int(line % height), int(line / height) };
          walk.claim(row, int(claim.Sample % width), 1, claim.Cell);
        }
        walk.flush();
      });
    const Access access(this->Mesh);
    for (std::size_t i = 0; border && i < claims.size(); ++i)
    {
      const BorderClaim& claim = claims[i];
      const int rank = borderRank(access, this->Axes, claim.Sample, claim.Cell);
      border->push_back({ claim.Sample, withRank(keyOf(access, claim.Cell), rank) });
    }
  }

  const SimplexMesh& Mesh;
  const LatticeAxes& Axes;
  const std::vector<Attribute>& Attributes;
  const InterpolationOptions& Options;
  std::vector<Walk> Walks;
  DirectResult Result;
};

/// `claimed`: the number of samples that a device has filled already, which `options.Valid` marks.
/// For `border`, which may be null, see samplePartDirectly().
DirectResult sampleRest(const SimplexMesh& mesh, const LatticeAxes& axes,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options,
  std::int64_t claimed, std::vector<BorderSample>* border)
{
  DirectResult result;
  withAccess(mesh,
    [&](const auto& access)
    {
      using Access = std::decay_t<decltype(access)>;
      result = DirectSampler<Access>(mesh, axes, attributes, options).run(claimed, border);
    });
  return result;
}

DirectResult sampleAll(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options,
  std::vector<BorderSample>* border)
{
  const LatticeAxes axes(mesh, lattice);
  fillInChunks(options.Valid, axes.samples(), (unsigned char)(0), options.Threads);
  return sampleRest(mesh, axes, attributes, options, 0, border);
}

} // namespace

DirectResult sampleDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options)
{
  return sampleAll(mesh, lattice, attributes, options, nullptr);
}

DirectResult samplePartDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options,
  std::vector<BorderSample>& border)
{
  return sampleAll(mesh, lattice, attributes, options, &border);
}

DirectResult finishDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const InterpolationOptions& options,
  const SampledCells& sampled)
{
  const PartMesh part(mesh, sampled.Open);
  return sampleRest(
    part.mesh(), LatticeAxes(mesh, lattice), attributes, options, sampled.Claimed, nullptr);
}

} // namespace tipp
