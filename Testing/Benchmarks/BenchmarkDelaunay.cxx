// SPDX-License-Identifier: BSD-3-Clause
// Compares triangulation with its peers: the same points, from memory to memory, alternately.
#include "Arguments.h"
#include "Measure.h"
#include "PointSets.h"
#include "Points/ReadPoints.h"

#include <cstdio>
#include <stdexcept>

namespace
{

using namespace tipp::benchmark;

struct Contender
{
  std::string Name;
  std::function<Run()> Work;
  Measurement Best;
  bool Measured = false;
};

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<double> load(const Arguments::Input& input, std::uint64_t seed)
{
  return endsWith(input.Name, ".npy") ? tipp::readPoints(input.Name).XY
                                      : tipp::test::makePointSet(input.Name, input.Count, seed);
}

std::string label(const std::string& name)
{
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? name : name.substr(slash + 1);
}

std::vector<Contender> contenders(const Arguments& arguments, const std::vector<double>& xy)
{
  std::vector<Contender> all;
  if (arguments.hasPeer("cgal"))
  {
    all.push_back({ "CGAL, 1 thread", [&] { return runCgal(xy); }, {} });
  }
  if (arguments.hasPeer("kernel"))
  {
    all.push_back({ "kernel, 1 thread", [&] { return runKernel(xy); }, {} });
  }
  if (arguments.hasPeer("sweep"))
  {
    all.push_back({ "sweep, 1 thread", [&] { return runSweep(xy); }, {} });
  }
  for (const int threads : arguments.Threads)
  {
    tipp::TriangulationOptions options = arguments.Options;
    options.Threads = threads;
    const std::string suffix = std::to_string(threads) + (threads == 1 ? " thread" : " threads");
    all.push_back({ "TIPP, " + suffix, [&xy, options] { return runCore(xy, options); }, {} });
    if (arguments.hasPeer("filter"))
    {
      all.push_back({ "filter, " + suffix, [&xy, options] { return runFilter(xy, options); }, {} });
    }
  }
  if (arguments.hasPeer("vtk"))
  {
    all.push_back({ "vtkDelaunay2D", [&] { return runVtk(xy); }, {} });
  }
  return all;
}

/// Prints each phase's share of the whole run's time. A phase may be part of another one.
void printPhases(const Run& run)
{
  const tipp::TriangulationStatistics& statistics = run.Statistics;
  for (const auto& phase : statistics.Phases)
  {
    std::printf("    %-40s %9.4f s %6.2f %%\n", phase.Name.c_str(), phase.Seconds,
      100 * phase.Seconds / run.Seconds);
  }
  std::int64_t largest = 0;
  for (const auto& stage : statistics.Stages)
  {
    largest = std::max(largest, stage.MeshTriangles);
  }
  std::printf("    %zu stages, at most %lld unfinished triangles; %lld initial points\n",
    statistics.Stages.size(), (long long)largest, (long long)statistics.InitialPoints);
}

/// Ratios are relative to the first contender. 'same' says whether the triangles equal those of the
/// first contender; this is also returned.
bool print(const std::string& input, std::size_t count, const Contender& one,
  const Contender& first, bool phases)
{
  const Measurement& m = one.Best;
  const auto& statistics = m.Result.Statistics;
  const bool same = m.Result.Checksum == first.Best.Result.Checksum &&
    m.Result.Triangles == first.Best.Result.Triangles;
  std::printf("%-18s %10zu  %-16s %9.4f %8.1f %7.3g  %-4s %8.0f %8.0f", label(input).c_str(), count,
    one.Name.c_str(), m.Result.Seconds, 1e9 * m.Result.Seconds / double(count),
    first.Best.Result.Seconds / m.Result.Seconds, same ? "yes" : "NO", m.PeakMegabytes,
    m.OwnMegabytes);
  if (statistics.Partitions > 0)
  {
    std::printf(" %8.3f %7lld", double(statistics.WorkerVertices) / double(count),
      (long long)statistics.Partitions);
  }
  std::printf("\n");
  if (phases && !statistics.Phases.empty())
  {
    printPhases(m.Result);
  }
  std::fflush(stdout);
  return same;
}

/// Reads each page of the input. The first access to a parent's page costs a forked process time,
/// which must not be counted as the engine's.
void lookAt(const std::vector<double>& xy)
{
  constexpr std::size_t perPage = 4096 / sizeof(double);
  volatile double seen = 0;
  for (std::size_t i = 0; i < xy.size(); i += perPage)
  {
    seen = xy[i];
  }
  static_cast<void>(seen);
}

/// Whether all contenders made the same triangles.
bool compare(const Arguments& arguments, const Arguments::Input& input)
{
  const std::vector<double> xy = load(input, arguments.Seed);
  std::vector<Contender> all = contenders(arguments, xy);
  for (int i = 0; i < arguments.Repeat; ++i)
  {
    for (Contender& one : all)
    {
      const auto work = [&xy, &one]
      {
        lookAt(xy);
        return one.Work();
      };
      const Measurement m = measure(work);
      if (!one.Measured || m.Result.Seconds < one.Best.Result.Seconds)
      {
        one.Best = m;
        one.Measured = true;
      }
    }
  }
  bool same = true;
  for (const Contender& one : all)
  {
    same = print(input.Name, xy.size() / 2, one, all.front(), arguments.Phases) && same;
  }
  return same;
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    const Arguments arguments = parseArguments(argc, argv);
    if (arguments.Inputs.empty())
    {
      std::fputs(usage().c_str(), stdout);
      return 0;
    }
    std::printf("%-18s %10s  %-16s %9s %8s %7s  %-4s %8s %8s %8s %7s\n", "input", "points",
      "engine", "seconds", "ns/point", "faster", "same", "peak MB", "own MB", "vertices", "boxes");
    bool same = true;
    for (const Arguments::Input& input : arguments.Inputs)
    {
      same = compare(arguments, input) && same;
    }
    return same ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "benchmarkDelaunay: %s\n", error.what());
    return 1;
  }
}
