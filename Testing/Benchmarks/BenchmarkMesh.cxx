// SPDX-License-Identifier: BSD-3-Clause
// benchmarkMesh ENGINE FILE ANGLE AREA THREADS: meshes the lines of a file (see
// readConstraintFile()) once, and prints points, triangles, seconds, processor seconds, and the
// memory that it took besides the result. ENGINE is tipp or cgal. With ENGINE write, ANGLE is the
// path of a text file that gets the points and segments.
#include "Constraints/ReadConstraintFile.h"
#include "Engines.h"
#include "Refinement/MeshPoints.h"

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

namespace
{

using namespace tipp;

double peakBytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

int write(const ConstraintTable& table, const char* path)
{
  std::FILE* const file = std::fopen(path, "w");
  if (!file)
  {
    std::perror(path);
    return 1;
  }
  std::fprintf(file, "%zu %zu\n", table.XY.size() / 2, table.Edges.size());
  for (std::size_t i = 0; i < table.XY.size(); i += 2)
  {
    std::fprintf(file, "%.17g %.17g\n", table.XY[i], table.XY[i + 1]);
  }
  for (const auto& [a, b] : table.Edges)
  {
    std::fprintf(file, "%lld %lld\n", (long long)a, (long long)b);
  }
  return std::fclose(file) == 0 ? 0 : 1;
}

int mesh(
  const std::string& engine, const ConstraintTable& table, double angle, double area, int threads)
{
  SourceConstraints source;
  for (const auto& [a, b] : table.Edges)
  {
    source.Constraints.push_back({ a, b });
  }
  source.PolygonBegin = source.Constraints.size();
  const double before = peakBytes();
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  std::size_t triangles = 0;
  std::size_t points = 0;
  double result = 0; // its bytes
  if (engine == "cgal")
  {
    triangles =
      std::size_t(benchmark::runCgalMesh(table.XY, source.Constraints, angle, area).Triangles);
  }
  else
  {
    MeshRequest request;
    request.Source = &source;
    request.Refinement.MinimumAngle = angle;
    request.Refinement.LargestArea = area;
    request.Refinement.Threads = threads;
    std::vector<std::string> warnings;
    const PointsMesh made =
      meshPoints(PointsView(table.XY.data(), table.XY.size() / 2, 2), request, warnings);
    triangles = made.Mesh.triangleCount();
    points = table.XY.size() / 2 + made.NewXY.size() / 2;
    result = 12.0 * double(triangles) + 24.0 * double(made.NewXY.size() / 2);
  }
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%zu %zu %.4f %.4f %.1f\n", points, triangles, seconds,
    double(std::clock() - processor) / CLOCKS_PER_SEC,
    (peakBytes() - before - result) / double(triangles));
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 4)
  {
    std::fprintf(
      stderr, "usage: benchmarkMesh tipp|cgal FILE ANGLE AREA THREADS, or write FILE OUTPUT\n");
    return 2;
  }
  try
  {
    const ConstraintTable table = readConstraintFile(argv[2]);
    return std::string(argv[1]) == "write" || argc < 6
      ? write(table, argv[3])
      : mesh(argv[1], table, std::atof(argv[3]), std::atof(argv[4]), std::atoi(argv[5]));
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
