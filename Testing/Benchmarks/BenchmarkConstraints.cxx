// SPDX-License-Identifier: BSD-3-Clause
// Compares constrained triangulation with its peers:
// benchmarkConstraints POINTS SEGMENTS [REPEAT [vtk | alone]]
// alone: without peers, but with the times of our phases. TIPP without and with segments runs by
// turns. POINTS: a number of uniform points, or a .npy file. SEGMENTS: a number of edges of the
// triangulation of every eighth point, which do not cross; 1 is a segment across the whole domain;
// a .npy file has two point indices per segment, and segments that cross others are left out. Times
// are from points in memory to triangles in memory.
#include "Engines.h"
#include "Measure.h"
#include "PointSets.h"

#include "Constraints/ResolveCrossings.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::benchmark;

std::vector<Constraint> makeSegments(std::vector<double>& xy, std::size_t wanted)
{
  std::vector<Constraint> segments;
  if (wanted == 1)
  {
    xy.insert(xy.end(), { -0.01, 0.31, 1.01, 0.72 });
    const PointId last = PointId(xy.size() / 2 - 1);
    return { { last - 1, last } };
  }
  constexpr std::size_t step = 8;
  std::vector<double> sparse;
  for (std::size_t i = 0; i < xy.size() / 2; i += step)
  {
    sparse.insert(sparse.end(), { xy[2 * i], xy[2 * i + 1] });
  }
  TriangulationOptions alone; // this process must not start threads: measure() forks
  alone.Threads = 1;
  const Triangulation mesh = triangulate(PointsView(sparse.data(), sparse.size() / 2, 2), alone);
  const auto id = [](std::int32_t place) { return PointId(place) * PointId(step); };
  const std::size_t edges = mesh.Ids32.size() / 2; // each edge is in two triangles
  const std::size_t every = std::max<std::size_t>(1, edges / wanted);
  std::size_t count = 0;
  for (std::size_t h = 0; h < mesh.Ids32.size() && segments.size() < wanted; ++h)
  {
    const std::int32_t a = mesh.Ids32[h];
    const std::int32_t b = mesh.Ids32[h % 3 == 2 ? h - 2 : h + 1];
    if (a < b && count++ % every == 0)
    {
      segments.push_back({ id(a), id(b) });
    }
  }
  return segments;
}

bool isFile(const std::string& argument)
{
  return argument.size() > 4 && argument.substr(argument.size() - 4) == ".npy";
}

/// The segments of a file that cross no other segment.
std::vector<Constraint> readSegments(const std::vector<double>& xy, const std::string& path)
{
  const std::vector<double> ids = readPoints(path).XY;
  std::vector<Constraint> all;
  for (std::size_t i = 0; i < ids.size(); i += 2)
  {
    all.push_back({ PointId(ids[i]), PointId(ids[i + 1]) });
  }
  const PointsView points(xy.data(), xy.size() / 2, 2);
  // This process must not start threads, because measure() forks.
  std::vector<char> crosses(all.size(), 0);
  const ResolvedConstraints resolved = resolveCrossings(points, all, CrossingRule::Split, 1);
  for (const IdSegment& segment : resolved.Segments)
  {
    const Constraint& whole = all[std::size_t(segment.Constraint)];
    crosses[std::size_t(segment.Constraint)] |= char(whole.A != segment.A || whole.B != segment.B);
  }
  std::vector<Constraint> segments;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (!crosses[i])
    {
      segments.push_back(all[i]);
    }
  }
  std::printf("%zu segments cross others and are left out\n", all.size() - segments.size());
  return segments;
}

/// Something to be measured.
struct Candidate
{
  std::string Name;
  std::function<Run()> Work;
};

void print(const std::string& name, const Measurement& best, bool tellsPhases)
{
  std::printf("%-28s %9.3f s %12lld triangles  %016llx  %8.0f MB\n", name.c_str(),
    best.Result.Seconds, (long long)best.Result.Triangles, (unsigned long long)best.Result.Checksum,
    best.PeakMegabytes);
  if (best.Result.Recovered >= 0)
  {
    std::printf("%28s %lld segments are edges\n", "", (long long)best.Result.Recovered);
  }
  for (const auto& phase : best.Result.Statistics.Phases)
  {
    if (tellsPhases)
    {
      std::printf("%28s %-18s %7.3f s\n", "", phase.Name.c_str(), phase.Seconds);
    }
  }
  std::fflush(stdout);
}

/// Measures the candidates by turns, and prints the fastest run of each.
void report(const std::vector<Candidate>& candidates, int repeat, bool tellsPhases)
{
  std::vector<Measurement> best(candidates.size());
  for (int i = 0; i < repeat; ++i)
  {
    for (std::size_t c = 0; c < candidates.size(); ++c)
    {
      Measurement m = measure(candidates[c].Work);
      if (i == 0 || m.Result.Seconds < best[c].Result.Seconds)
      {
        best[c] = std::move(m);
      }
    }
  }
  for (std::size_t c = 0; c < candidates.size(); ++c)
  {
    print(candidates[c].Name, best[c], tellsPhases);
  }
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::fputs("usage: benchmarkConstraints POINTS SEGMENTS [REPEAT [vtk | alone]]\n", stderr);
    return 2;
  }
  try
  {
    std::vector<double> xy = isFile(argv[1])
      ? readPoints(argv[1]).XY
      : test::makePointSet("uniform", std::size_t(std::strtod(argv[1], nullptr)));
    const int repeat = argc > 3 ? std::atoi(argv[3]) : 3;
    const std::vector<Constraint> segments = isFile(argv[2])
      ? readSegments(xy, argv[2])
      : makeSegments(xy, std::size_t(std::strtod(argv[2], nullptr)));
    std::printf("%zu points, %zu segments\n", xy.size() / 2, segments.size());
    const std::string peers = argc > 4 ? argv[4] : "";
    const bool isAlone = peers == "alone";
    if (!isAlone)
    {
      report(
        { { "CGAL, 1 thread", [&] { return runCgalConstrained(xy, segments); } } }, repeat, false);
    }
    for (const int threads : { 1, 2 })
    {
      TriangulationOptions options;
      options.Threads = threads;
      const std::string suffix = std::to_string(threads) + (threads == 1 ? " thread" : " threads");
      report({ { "TIPP without, " + suffix, [&] { return runCore(xy, options); } },
               { "TIPP, " + suffix, [&] { return runConstrained(xy, segments, options); } } },
        repeat, isAlone);
    }
    if (peers == "vtk")
    {
      report({ { "vtkDelaunay2D", [&] { return runVtkConstrained(xy, segments); } } }, 1, false);
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "benchmarkConstraints: %s\n", error.what());
    return 1;
  }
}
