// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra beside CGAL: benchmarkDelaunay3D KIND POINTS [REPEAT]. KIND is one of pointsInSpace().
// Points in memory to tetrahedra in memory; wall-clock seconds, of which the fastest run counts.
#include "EngineCgal3D.h"
#include "PointsInSpace.h"

#include "Kernel3D/DelaunayKernel3.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>

namespace
{

using namespace tipp;

struct Timing
{
  double Seconds = std::numeric_limits<double>::infinity();
  std::size_t Cells = 0;

  void time(const std::function<std::size_t()>& work)
  {
    const Stopwatch watch;
    this->Cells = work();
    this->Seconds = std::min(this->Seconds, watch.seconds());
  }
};

double kernelBytesPerCell(const std::vector<Point3>& points)
{
  DelaunayKernel3 kernel;
  kernel.triangulate(points.data(), points.size());
  std::size_t cells = 0;
  kernel.forEach([&](DelaunayKernel3::Index t) { cells += kernel.isInfinite(t) ? 0 : 1; });
  return double(kernel.bytes()) / double(std::max<std::size_t>(cells, 1));
}

} // namespace

int main(int argc, char** argv)
{
  const auto& kinds = test::kindsOfPoints();
  if (argc < 3 || std::find(kinds.begin(), kinds.end(), argv[1]) == kinds.end())
  {
    std::fprintf(stderr, "usage: benchmarkDelaunay3D KIND POINTS [REPEAT]\n");
    return 2;
  }
  const auto points = test::pointsInSpace(argv[1], std::size_t(std::atof(argv[2])));
  const int repeat = argc > 3 ? std::atoi(argv[3]) : 3;
  Timing cgal;
  Timing one;
  Timing two;
  const auto ours = [&points](int threads)
  {
    TetrahedralizationOptions options;
    options.Threads = threads;
    return tetrahedralize(points.data(), points.size(), options).cellCount();
  };
  for (int i = 0; i < repeat; ++i)
  {
    cgal.time([&] { return benchmark::tetrahedralizeByCgal(points); });
    one.time([&] { return ours(1); });
    two.time([&] { return ours(2); });
  }
  if (cgal.Cells != one.Cells || one.Cells != two.Cells)
  {
    std::fprintf(stderr, "benchmarkDelaunay3D: the numbers of tetrahedra differ.\n");
    return 1;
  }
  std::printf(
    "%-13s %9zu points %10zu tetrahedra  CGAL %8.3f s  1 thread %8.3f s (%.2fx)  2 threads "
    "%8.3f s (%.2fx)  %.1f bytes/tetrahedron\n",
    argv[1], points.size(), one.Cells, cgal.Seconds, one.Seconds, cgal.Seconds / one.Seconds,
    two.Seconds, cgal.Seconds / two.Seconds, kernelBytesPerCell(points));
  return 0;
}
