// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Resample.h"

#include "Parallel/Stopwatch.h"
#include "Resample/CellVisitor.h"
#include "Resample/ClaimSamples.h"
#include "Resample/NearBorder.h"
#include "Resample/SampleBlock.h"
#include "Resample/SamplingAccess.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

/// Writes the null value to the samples in [first, end) for which wanted(sample) is true.
template <typename Wanted>
void fillNull(
  const Attribute& attribute, std::int64_t first, std::int64_t end, const Wanted& wanted)
{
  withScalar(attribute.Type,
    [&](auto type)
    {
      using T = decltype(type);
      const T null = toScalar<T>(attribute.NullValue);
      const int components = attribute.Components;
      T* const samples = static_cast<T*>(attribute.Samples);
      for (std::int64_t i = first; i < end; ++i)
      {
        if (wanted(i))
        {
          std::fill(samples + i * components, samples + (i + 1) * components, null);
        }
      }
    });
}

/// Fills the samples of claims [first, last) that do not need interpolation; claim i is sample i +
/// shift of the whole lattice.
void fillRest(const std::vector<Attribute>& attributes, const std::int32_t* claims,
  std::int64_t first, std::int64_t last, std::int64_t shift, const ResampleOptions& options)
{
  const auto claimed = [claims, shift](std::int64_t i) { return claims[i - shift] >= 0; };
  const std::int64_t begin = first + shift;
  const std::int64_t end = last + shift;
  for (const Attribute& attribute : attributes)
  {
    if (!options.Keys)
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
    options.Valid[i] = is || !options.Keys ? is : options.Valid[i];
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
        if (claims[soon] >= 0)
        {
          access.prefetch(claims[soon]);
        }
        __builtin_prefetch(access.ids(std::max(claims[later], 0)));
        work(cell, row, int(first - rowBegin), int(i - first));
      }
    }
  }
}

} // namespace

bool interpolate(const SimplexMesh& mesh, const SampleWindow& window, const std::int32_t* claims,
  const std::vector<Attribute>& attributes, const ResampleOptions& options)
{
  const LatticeAxes axes(mesh, window.lattice());
  bool completed = false;
  withSamplingAccess(mesh,
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
    const std::vector<Attribute>& attributes, const ResampleOptions& options)
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
  const ResampleOptions& Options;
  SampleBlock<Access> Block;
};

/// Sets the samples outside of all cells to their null values. Returns the number of samples
/// inside.
std::int64_t finishSamples(
  std::int64_t samples, const std::vector<Attribute>& attributes, const ResampleOptions& options)
{
  return sumOfChunks(samples, 1 << 16, options.Threads,
    [&](std::int64_t begin, std::int64_t end)
    {
      const auto always = [](std::int64_t) { return true; };
      std::int64_t inside = end - begin;
      forZeros(options.Valid, begin, end,
        [&](std::int64_t first, std::int64_t last)
        {
          inside -= last - first;
          for (const Attribute& attribute : attributes)
          {
            if (attribute.Values)
            {
              fillNull(attribute, first, last, always);
            }
          }
        });
      for (const Attribute& attribute : attributes)
      {
        if (!attribute.Values)
        {
          fillNull(attribute, begin, end, always);
        }
      }
      return inside;
    });
}

/// Fills the samples on the mesh's border, and adds them to `border` if it is not null.
template <typename Access>
void fillBorder(const Access& access, const LatticeAxes& axes,
  const std::vector<BorderClaim>& claims, std::vector<FillingWalk<Access>>& walks,
  std::vector<BorderSample>* border)
{
  const std::int64_t width = axes.U.size();
  const std::int64_t height = axes.V.size();
  forChunks(std::int64_t(claims.size()), 1 << 10, int(walks.size()), {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      FillingWalk<Access>& walk = walks[std::size_t(thread)];
      for (std::int64_t i = begin; i < end; ++i)
      {
        const BorderClaim& claim = claims[std::size_t(i)];
        const std::int64_t line = claim.Sample / width;
        const SampleRow row{ line * width, int(line % height), int(line / height) };
        walk.claim(row, int(claim.Sample % width), 1, claim.Cell);
      }
      walk.flush();
    });
  for (std::size_t i = 0; border && i < claims.size(); ++i)
  {
    const BorderClaim& claim = claims[i];
    const int rank = borderRank(access, axes, claim.Sample, claim.Cell);
    border->push_back({ claim.Sample, withRank(keyOf(access, claim.Cell), rank) });
  }
}

/// `claimed`: the number of samples that a device has filled already, which `options.Valid` marks.
/// For `border`, which may be null, see sampleDirectly(). Sets `boxes` to those of the mesh.
DirectResult sampleRest(const SimplexMesh& mesh, const LatticeAxes& axes,
  const std::vector<Attribute>& attributes, const ResampleOptions& options, std::int64_t claimed,
  std::vector<BorderSample>* border, GroupBoxes& boxes)
{
  DirectResult result;
  withSamplingAccess(mesh,
    [&](const auto& access)
    {
      using Access = std::decay_t<decltype(access)>;
      std::vector<FillingWalk<Access>> walks(
        std::size_t(options.Threads), FillingWalk<Access>(mesh, axes, attributes, options));
      CellVisitor<Access, FillingWalk<Access>> visitor(mesh, axes, walks);
      result.Aborted = !visitor.run(options.Progress);
      boxes = std::move(visitor.boxes());
      std::vector<Touch> touches = joinWalks(walks, result.Statistics, claimed);
      const Stopwatch watch;
      if (!result.Aborted)
      {
        result.Overlapping = finishSamples(axes.samples(), attributes, options) != claimed;
      }
      if (!result.Aborted && !result.Overlapping)
      {
        fillBorder(access, axes, borderClaims(mesh, axes, std::move(touches), options.Threads),
          walks, border);
      }
      result.FinishSeconds = watch.seconds();
    });
  return result;
}

/// Fills the samples near the border of a complete mesh or part, after those inside; see
/// Lattice::Slack. For `boxes` see nearSamples().
void fillNearBorder(const SimplexMesh& mesh, const LatticeAxes& axes,
  const std::vector<Attribute>& attributes, const ResampleOptions& options, const GroupBoxes& boxes,
  std::vector<BorderSample>* border)
{
  const std::vector<NearSample> samples =
    nearSamplesOf<unsigned char>(mesh, axes, options.Threads, boxes, options.Valid, 0);
  fillNear(samples, attributes, options.Parents);
  for (const NearSample& near : samples)
  {
    options.Valid[near.Sample] = 1;
    if (border)
    {
      border->push_back({ near.Sample, near.Key });
    }
  }
}

} // namespace

DirectResult sampleDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options,
  std::vector<BorderSample>* border)
{
  const LatticeAxes axes(mesh, lattice);
  fillInChunks(options.Valid, axes.samples(), (unsigned char)(0), options.Threads);
  GroupBoxes boxes;
  const DirectResult result = sampleRest(mesh, axes, attributes, options, 0, border, boxes);
  if (!result.Aborted && !result.Overlapping)
  {
    fillNearBorder(mesh, axes, attributes, options, boxes, border);
  }
  return result;
}

DirectResult finishDirectly(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options,
  const SampledCells& sampled)
{
  const PartMesh part(mesh, sampled.Open);
  const LatticeAxes axes(mesh, lattice);
  GroupBoxes boxes;
  const DirectResult result =
    sampleRest(part.mesh(), axes, attributes, options, sampled.Claimed, nullptr, boxes);
  if (!result.Aborted && !result.Overlapping)
  {
    fillNearBorder(mesh, axes, attributes, options, GroupBoxes(), nullptr);
  }
  return result;
}

namespace
{

/// With fewer cells and samples in total, CPU threads finish before a device has received its data.
constexpr std::int64_t worthATransfer = 1000000;

class Resampler
{
public:
  Resampler(const SimplexMesh& mesh, const Lattice& lattice,
    const std::vector<Attribute>& attributes, const ResampleOptions& options)
    : Mesh(mesh)
    , Grid(lattice)
    , Attributes(attributes)
    , Options(options)
    , Window(options.Keys ? SampleWindow::around(mesh, lattice, options.Threads)
                          : SampleWindow(mesh, lattice))
  {
  }

  ResampleResult run()
  {
    if (this->Options.Keys && this->Window.samples() == 0)
    {
      return this->Result; // the part is outside
    }
    this->tryDevice([&] { this->open(); });
    if (!this->Options.Keys && this->sampleAtOnce())
    {
      return this->Result;
    }
    const Report report = partOf(this->Options.Progress, 0, 0.7);
    Claims claims = this->compute<Claims>([&]
      { return this->Device->claim(this->Window.lattice(), report); },
      [&]
      { return claimSamples(this->Mesh, this->Window.lattice(), this->Options.Threads, report); });
    this->Result.Statistics = claims.Statistics;
    this->Result.Aborted = claims.Aborted;
    if (!claims.Aborted && this->Options.Keys)
    {
      mergeClaims(this->Mesh, claims, this->Window, this->Options.Threads, this->Options.Keys);
    }
    this->Result.ClaimSeconds += this->lap();
    if (!claims.Aborted)
    {
      this->Result.Aborted = !interpolate(this->Mesh, this->Window, claims.Cells.get(),
        this->Attributes, this->withProgress(partOf(this->Options.Progress, 0.7, 1)));
      this->fillNear(claims);
      this->Result.InterpolationSeconds += this->lap();
    }
    this->Result.Device = this->deviceName();
    return this->Result;
  }

private:
  void open()
  {
    const bool small = this->Mesh.Cells + this->Window.samples() < worthATransfer;
    if (this->Options.Device.Kind != tipp::Device::Auto || !small)
    {
      this->Device = DeviceResampler::open(this->Mesh, this->Options);
    }
    if (this->Device)
    {
      this->Transferred = this->Device->transferSeconds();
      this->Watch.restart();
    }
  }

  /// Samples in one pass. Returns false if that is not possible: cells overlap, or the device does
  /// not support the arrays.
  bool sampleAtOnce()
  {
    if (this->Device && !this->Device->canSample(this->Attributes))
    {
      return false;
    }
    std::vector<unsigned char> valid;
    ResampleOptions options = this->Options;
    if (!options.Valid)
    {
      valid.resize(std::size_t(this->Window.samples()));
      options.Valid = valid.data();
    }
    const DirectResult direct = this->compute<DirectResult>([&]
      { return this->Device->sample(this->Grid, this->Attributes, options); },
      [&] { return sampleDirectly(this->Mesh, this->Grid, this->Attributes, options); });
    this->Result.Statistics = direct.Statistics;
    this->Result.Aborted = direct.Aborted;
    this->Result.InterpolationSeconds = direct.FinishSeconds;
    this->Result.ClaimSeconds = this->lap() - direct.FinishSeconds;
    this->Result.Device = this->deviceName();
    return !direct.Overlapping;
  }

  /// Fills the samples that no cell contains; interpolate() has extrapolated their values.
  void fillNear(const Claims& claims)
  {
    const std::int64_t width = LatticeAxes(this->Mesh, this->Window.lattice()).U.size();
    std::vector<NearSample> kept;
    for (NearSample near : claims.Near)
    {
      if (claims.Cells[std::size_t(near.Sample)] == near.Cell)
      {
        near.Sample = this->Window.indexOf(near.Sample / width) + near.Sample % width;
        kept.push_back(near);
      }
    }
    tipp::fillNear(kept, this->Attributes, this->Options.Parents);
  }

  /// Seconds since the last lap without those of transfers, which are counted separately.
  double lap()
  {
    double transfer = 0;
    if (this->Device)
    {
      transfer = this->Device->transferSeconds() - this->Transferred;
      this->Transferred += transfer;
      this->Result.TransferSeconds += transfer;
    }
    return std::max(0.0, this->Watch.restart() - transfer);
  }

  std::string deviceName() const { return this->Device ? this->Device->name() : "OpenMP"; }

  /// Runs work on the device. If the device fails, it is not used again.
  template <typename Work>
  void tryDevice(const Work& work)
  {
    try
    {
      work();
    }
    catch (const UnknownDevice&)
    {
      throw;
    }
    catch (const AcceleratorError& error)
    {
      this->Device = nullptr;
      this->Result.Warning = std::string(error.what()) + " OpenMP does it instead.";
    }
  }

  /// Returns what the device computes or, if there is none or it fails, the threads.
  template <typename T, typename OnDevice, typename OnThreads>
  T compute(const OnDevice& onDevice, const OnThreads& onThreads)
  {
    std::optional<T> result;
    if (this->Device)
    {
      this->tryDevice([&] { result = onDevice(); });
    }
    return result ? std::move(*result) : onThreads();
  }

  ResampleOptions withProgress(const Report& progress) const
  {
    ResampleOptions options = this->Options;
    options.Progress = progress;
    return options;
  }

  const SimplexMesh& Mesh;
  const Lattice& Grid;
  const std::vector<Attribute>& Attributes;
  const ResampleOptions& Options;
  SampleWindow Window;                     ///< the samples that are considered
  std::unique_ptr<DeviceResampler> Device; ///< null: OpenMP
  Stopwatch Watch;
  double Transferred = 0; ///< the device's transfer time at the last lap
  ResampleResult Result;
};

} // namespace

#ifdef TIPP_SAMPLES_DOUBLES
namespace
{

/// Returns the coordinates as doubles if they have 32 bits; otherwise null.
std::unique_ptr<double[]> widened(const SimplexMesh& mesh, int threads)
{
  if (!mesh.Float)
  {
    return nullptr;
  }
  std::unique_ptr<double[]> points(new double[3 * std::size_t(mesh.PointCount)]);
  const auto* const narrow = static_cast<const float*>(mesh.Points);
  forChunks(3 * mesh.PointCount, 1 << 16, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    { std::copy(narrow + begin, narrow + end, points.get() + begin); });
  return points;
}

} // namespace
#endif

ResampleResult resample(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options)
{
  const ThreadLimit limit(options.Threads); // for copies to and from a device
#ifdef TIPP_SAMPLES_DOUBLES
  const std::unique_ptr<double[]> points = widened(mesh, options.Threads);
  SimplexMesh wide = mesh;
  wide.Points = points ? points.get() : mesh.Points;
  wide.Float = false;
  return Resampler(wide, lattice, attributes, options).run();
#else
  return Resampler(mesh, lattice, attributes, options).run();
#endif
}

} // namespace tipp
