// SPDX-License-Identifier: BSD-3-Clause
// Compares tetrahedra with CGAL, also on two threads with TBB, with TetGen and, for up to 100,000
// points, with vtkDelaunay3D: benchmarkDelaunay3D KIND POINTS [REPEAT]. KIND is a kind of
// pointsInSpace(). Prints wall-clock seconds of the fastest run, from points in memory to
// tetrahedra in memory.
#include "Engines3D.h"
#include "PointsInSpace.h"

#include "Kernel/DelaunayKernel3.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation3D/Tetrahedralize.h"

#include "vtkDelaunay3D.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::benchmark;

struct Engine
{
  const char* Name;
  std::function<std::size_t()> Run; ///< returns the number of tetrahedra
  double Seconds = std::numeric_limits<double>::infinity();
  std::size_t Cells = 0;
};

std::size_t ours(const std::vector<Point3>& points, int threads)
{
  TetrahedralizationOptions options;
  options.Threads = threads;
  return tetrahedralize(points.data(), points.size(), options).cellCount();
}

std::size_t tetrahedralizeByVtk(const std::vector<Point3>& points)
{
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  for (const Point3& p : points)
  {
    positions->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(positions);
  vtkNew<vtkDelaunay3D> delaunay;
  delaunay->SetInputData(input);
  delaunay->Update();
  return std::size_t(delaunay->GetOutput()->GetNumberOfCells());
}

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
  std::vector<Engine> engines = { { "CGAL", [&] { return tetrahedralizeByCgal(points); } },
    { "1 thread", [&] { return ours(points, 1); } },
    { "2 threads", [&] { return ours(points, 2); } } };
#ifdef TIPP_HAVE_TBB
  engines.push_back(
    { "CGAL, TBB, 2 threads", [&] { return tetrahedralizeByParallelCgal(points); } });
#endif
#ifdef TIPP_HAVE_TETGEN
  engines.push_back({ "TetGen", [&] { return tetrahedralizeByTetgen(points); } });
#endif
  constexpr std::size_t mostOfVtk = 100'000;
  if (points.size() <= mostOfVtk)
  {
    engines.push_back({ "vtkDelaunay3D", [&] { return tetrahedralizeByVtk(points); } });
  }
  for (int i = 0; i < repeat; ++i)
  {
    for (Engine& engine : engines)
    {
      const Stopwatch watch;
      engine.Cells = engine.Run();
      engine.Seconds = std::min(engine.Seconds, watch.seconds());
    }
  }
  if (engines[0].Cells != engines[1].Cells || engines[1].Cells != engines[2].Cells)
  {
    std::fprintf(stderr, "benchmarkDelaunay3D: the numbers of tetrahedra differ.\n");
    return 1;
  }
  std::printf("%s: %zu points, %.1f bytes a tetrahedron\n", argv[1], points.size(),
    kernelBytesPerCell(points));
  for (const Engine& engine : engines)
  {
    std::printf("  %-20s %10zu tetrahedra %8.3f s  1 thread %5.2fx  2 threads %5.2fx\n",
      engine.Name, engine.Cells, engine.Seconds, engine.Seconds / engines[1].Seconds,
      engine.Seconds / engines[2].Seconds);
  }
  return 0;
}
