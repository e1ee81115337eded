// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Resample.h"

#include "OpenCL/Devices.h"
#include "Parallel/Stopwatch.h"
#include "Resample/CellVisitor.h"
#include "Resample/Interpolate.h"

#include <memory>
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
    Claims claims = this->claim();
    this->Result.Statistics = claims.Statistics;
    this->Result.Aborted = claims.Aborted;
    if (!claims.Aborted && this->Options.Keys)
    {
      mergeClaims(this->Mesh, claims, this->Window, this->Options.Threads, this->Options.Keys);
    }
    this->Result.ClaimSeconds += this->lap();
    if (!claims.Aborted)
    {
      this->fill(claims.Cells.get());
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

  /// Samples in one pass. Returns false if that is not possible: cells overlap, or the device needs
  /// several steps.
  bool sampleAtOnce()
  {
    if (this->Device && !this->Device->canSample(this->Attributes))
    {
      return false;
    }
    std::vector<unsigned char> valid;
    InterpolationOptions options = this->interpolation();
    options.SkipInterpolated = false;
    if (!options.Valid)
    {
      valid.resize(std::size_t(this->Window.samples()));
      options.Valid = valid.data();
    }
    SampledCells sampled;
    if (this->Device)
    {
      this->tryDevice(
        [&]
        {
          sampled = this->Device->sample(
            this->Grid, this->Attributes, options.Valid, partOf(this->Options.Progress, 0, 0.9));
        });
    }
    options.Progress =
      this->Device ? partOf(this->Options.Progress, 0.9, 1) : this->Options.Progress;
    const DirectResult direct = sampled.Aborted ? DirectResult{ {}, 0, false, true }
      : this->Device ? finishDirectly(this->Mesh, this->Grid, this->Attributes, options, sampled)
                     : sampleDirectly(this->Mesh, this->Grid, this->Attributes, options);
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

  Claims claim()
  {
    const Report report = partOf(this->Options.Progress, 0, 0.7);
    Claims claims;
    if (this->Device)
    {
      this->tryDevice([&] { claims = this->Device->claim(this->Window.lattice(), report); });
    }
    return this->Device
      ? std::move(claims)
      : claimSamples(this->Mesh, this->Window.lattice(), this->Options.Threads, report);
  }

  void fill(const std::int32_t* claims)
  {
    const Report report = partOf(this->Options.Progress, 0.7, 1);
    bool completed = true;
    if (this->Device)
    {
      this->tryDevice(
        [&]
        {
          completed = this->Device->interpolate(this->Window, claims, this->Attributes,
            this->Options.Keys != nullptr, partOf(report, 0, 0.7));
        });
    }
    InterpolationOptions interpolation = this->interpolation();
    interpolation.Progress = this->Device ? partOf(report, 0.7, 1) : report;
    this->Result.Aborted =
      !completed || !interpolate(this->Mesh, this->Window, claims, this->Attributes, interpolation);
  }

  InterpolationOptions interpolation() const
  {
    InterpolationOptions options;
    options.Threads = this->Options.Threads;
    options.FillUnclaimed = !this->Options.Keys;
    options.SkipInterpolated = this->Device != nullptr;
    options.Parents = this->Options.Parents;
    options.Valid = this->Options.Valid;
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
  return Resampler(mesh, lattice, attributes, options).run();
}

} // namespace tipp
