// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Resample.h"

#include "OpenCL/Devices.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Resample/Interpolate.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace tipp
{
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
        this->Attributes, this->interpolation(partOf(this->Options.Progress, 0.7, 1)));
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
    InterpolationOptions options = this->interpolation(this->Options.Progress);
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

  InterpolationOptions interpolation(const Report& progress) const
  {
    InterpolationOptions options;
    options.Threads = this->Options.Threads;
    options.FillUnclaimed = !this->Options.Keys;
    options.Parents = this->Options.Parents;
    options.Valid = this->Options.Valid;
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

ResampleResult resample(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options)
{
  const ThreadLimit limit(options.Threads); // for copies to and from a device
  return Resampler(mesh, lattice, attributes, options).run();
}

} // namespace tipp
