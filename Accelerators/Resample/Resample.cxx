// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Resample.h"

#include "Resample/CellVisitor.h"
#include "Resample/ResampleOnDevice.h"

#include <chrono>
#include <utility>

namespace tipp
{
namespace
{

class Clock
{
public:
  double seconds()
  {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> since = now - this->Last;
    this->Last = now;
    return since.count();
  }

private:
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
};

/// The part of the work from `begin` to `end` as a report of its own.
Report part(const Report& report, double begin, double end)
{
  if (!report)
  {
    return {};
  }
  return [&report, begin, end](double done) { return report(begin + done * (end - begin)); };
}

/// Fewer cells and samples together are done before a device has its data.
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
    , Samples(LatticeAxes(mesh, lattice).samples())
  {
  }

  ResampleResult run()
  {
    this->tryDevice([&] { this->open(); });
    Clock clock;
    Claims claims = this->claim();
    this->Result.Statistics = claims.Statistics;
    this->Result.Aborted = claims.Aborted;
    if (!claims.Aborted && this->Options.Keys)
    {
      mergeClaims(this->Mesh, claims, this->Samples, this->Options.Threads, this->Options.Keys);
    }
    this->Result.ClaimSeconds = clock.seconds();
    if (!claims.Aborted)
    {
      this->fill(claims.Cells.get());
      this->Result.InterpolationSeconds = clock.seconds();
    }
    this->Result.Device = this->Device ? this->Device->description().Name : "OpenMP";
    return this->Result;
  }

private:
  void open()
  {
    const bool small = this->Mesh.Cells + this->Samples < worthATransfer;
    if (this->Options.Device.Kind != tipp::Device::Auto || !small)
    {
      this->Device = ComputeDevice::open(this->Options.Device);
    }
  }

  /// If the device fails, it is not asked again.
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
    const Report report = part(this->Options.Progress, 0, 0.7);
    Claims claims;
    if (this->Device)
    {
      this->tryDevice(
        [&]
        {
          claims = claimOnDevice(*this->Device, this->Mesh, this->Grid, this->Options.Threads,
            this->Options.DeviceMemory, report);
        });
    }
    return this->Device ? std::move(claims)
                        : claimSamples(this->Mesh, this->Grid, this->Options.Threads, report);
  }

  void fill(const std::int32_t* claims)
  {
    if (this->Device)
    {
      this->tryDevice(
        [&]
        {
          interpolateOnDevice(*this->Device, this->Mesh, this->Grid, claims, this->Attributes,
            this->Options.DeviceMemory);
        });
    }
    InterpolationOptions interpolation;
    interpolation.Threads = this->Options.Threads;
    interpolation.FillUnclaimed = !this->Options.Keys;
    interpolation.SkipInterpolated = this->Device != nullptr;
    interpolation.Parents = this->Options.Parents;
    interpolation.Valid = this->Options.Valid;
    interpolation.Progress = part(this->Options.Progress, 0.7, 1);
    this->Result.Aborted =
      !interpolate(this->Mesh, this->Grid, claims, this->Attributes, interpolation);
  }

  const SimplexMesh& Mesh;
  const Lattice& Grid;
  const std::vector<Attribute>& Attributes;
  const ResampleOptions& Options;
  std::int64_t Samples;
  ComputeDevice* Device = nullptr;
  ResampleResult Result;
};

} // namespace

ResampleResult resample(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options)
{
  return Resampler(mesh, lattice, attributes, options).run();
}

} // namespace tipp
