// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Resample.h"

#include "Resample/CellVisitor.h"

#include <chrono>

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

ResampleResult resampleOpenMP(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options)
{
  ResampleResult result;
  result.Device = "OpenMP";
  Clock clock;
  Claims claims = claimSamples(mesh, lattice, options.Threads, part(options.Progress, 0, 0.7));
  result.Statistics = claims.Statistics;
  result.Aborted = claims.Aborted;
  if (!result.Aborted && options.Keys)
  {
    const std::int64_t samples = LatticeAxes(mesh, lattice).samples();
    mergeClaims(mesh, claims, samples, options.Threads, options.Keys);
  }
  result.ClaimSeconds = clock.seconds();
  if (result.Aborted)
  {
    return result;
  }
  InterpolationOptions interpolation;
  interpolation.Threads = options.Threads;
  interpolation.FillUnclaimed = !options.Keys;
  interpolation.Parents = options.Parents;
  interpolation.Valid = options.Valid;
  interpolation.Progress = part(options.Progress, 0.7, 1);
  result.Aborted = !interpolate(mesh, lattice, claims.Cells.get(), attributes, interpolation);
  result.InterpolationSeconds = clock.seconds();
  return result;
}

} // namespace

ResampleResult resample(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options)
{
  return resampleOpenMP(mesh, lattice, attributes, options);
}

} // namespace tipp
