// SPDX-License-Identifier: BSD-3-Clause
// Measures conservative averages of a mesh of random points over the triangles of another one and
// over pixels; see Utilities/benchmarks/remap.sh. Arguments: TRIANGLES PIXELS REPEAT, PIXELS along
// each axis.
#include "ProcessorTime.h"

#include "Distributions/GeneratePoints.h"
#include "Overlap/AddOverlaps.h"
#include "Predicates/ExactArithmetic.h"
#include "Triangulation/Triangulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

using namespace tipp;
using namespace tipp::benchmark;

namespace
{

/// A triangulation of the unit square, with a value per cell and per point.
struct Square
{
  Square(std::int64_t triangles, std::uint64_t seed)
  {
    std::vector<double> xy = generatePoints(Distribution::Uniform, triangles / 2, seed);
    xy.insert(xy.end(), { 0, 0, 1, 0, 0, 1, 1, 1 });
    this->Triangles = triangulate(PointsView(xy.data(), xy.size() / 2, 2));
    for (std::size_t i = 0; i < xy.size() / 2; ++i)
    {
      this->Points.insert(this->Points.end(), { xy[2 * i], xy[2 * i + 1], 0.0 });
      this->AtPoints.push_back(std::sin(9 * xy[2 * i]) * std::cos(7 * xy[2 * i + 1]));
    }
    this->Mesh.Points = this->Points.data();
    this->Mesh.PointCount = std::int64_t(xy.size() / 2);
    this->Mesh.Wide = this->Triangles.Ids32.empty();
    this->Mesh.Ids = this->Mesh.Wide ? static_cast<const void*>(this->Triangles.Ids64.data())
                                     : static_cast<const void*>(this->Triangles.Ids32.data());
    this->Mesh.Cells = std::int64_t(this->Triangles.triangleCount());
    const PlaneCorners corners{ *this };
    for (std::int64_t i = 0; i < this->Mesh.Cells; ++i)
    {
      double mean = 0;
      for (int k = 0; k < 3; ++k)
      {
        mean += this->AtPoints[corners.id(i, k)] / 3;
      }
      this->OfCells.push_back(mean);
    }
  }

  struct PlaneCorners
  {
    const Square& Of;
    std::size_t id(std::int64_t cell, int corner) const
    {
      const std::size_t at = std::size_t(3 * cell + corner);
      return std::size_t(
        Of.Mesh.Wide ? std::int64_t(Of.Triangles.Ids64[at]) : std::int64_t(Of.Triangles.Ids32[at]));
    }
  };

  double integralOfCells() const
  {
    const PlaneCorners corners{ *this };
    ExactSum sum;
    for (std::int64_t i = 0; i < this->Mesh.Cells; ++i)
    {
      const double* p[3];
      for (int k = 0; k < 3; ++k)
      {
        p[k] = this->Points.data() + 3 * corners.id(i, k);
      }
      const double twice =
        (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
      sum.add(twice / 2 * this->OfCells[std::size_t(i)]);
    }
    return sum.value();
  }

  std::vector<double> Points;
  std::vector<double> AtPoints;
  std::vector<double> OfCells;
  Triangulation Triangles;
  SimplexMesh Mesh;
};

double integralIn(const OverlapSums& sums)
{
  ExactSum sum;
  for (std::int64_t i = 0; i < sums.targets(); ++i)
  {
    sum.add(sums.of(i)[1].value());
  }
  return sum.value();
}

void row(const char* name, int repeat, double expected, const std::function<OverlapSums()>& work)
{
  double wall = HUGE_VAL;
  double processor = HUGE_VAL;
  double found = 0;
  for (int i = 0; i < repeat; ++i)
  {
    const auto begin = std::chrono::steady_clock::now();
    const double beginOfProcessor = processorSeconds();
    const OverlapSums sums = work();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    processor = std::min(processor, processorSeconds() - beginOfProcessor);
    wall = std::min(wall, taken.count());
    found = integralIn(sums);
  }
  std::printf("| %s | %.3f s | %.3f s | %.1e |\n", name, wall, processor,
    std::fabs(found - expected) / std::fabs(expected));
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 4)
  {
    std::fprintf(stderr, "usage: benchmarkRemap TRIANGLES PIXELS REPEAT\n");
    return 2;
  }
  const std::int64_t triangles = std::atoll(argv[1]);
  const int pixels = std::atoi(argv[2]);
  const int repeat = std::atoi(argv[3]);
  const Square source(triangles, 1);
  const Square target(triangles, 2);
  const int threads = threadCount(0);
  OverlapSource cells{ source.Mesh, nullptr, { { source.OfCells.data(), 1, true } } };
  OverlapSource points{ source.Mesh, nullptr, { { source.AtPoints.data(), 1, false } } };
  // The mean of a linear field is that at the centre: both have the same integral.
  const double expected = source.integralOfCells();
  std::printf("%lld triangles onto %lld, and onto %d x %d pixels, %d threads\n\n",
    static_cast<long long>(source.Mesh.Cells), static_cast<long long>(target.Mesh.Cells), pixels,
    pixels, threads);
  std::printf("| what | time | processor | error of the integral |\n|---|---|---|---|\n");
  for (OverlapSource* const from : { &cells, &points })
  {
    const std::string kind = from == &cells ? "values of cells" : "values of points";
    row((kind + ", triangles").c_str(), repeat, expected,
      [&]
      {
        OverlapSums sums(target.Mesh.Cells, 1);
        addOverlaps(target.Mesh, *from, sums, threads, {});
        return sums;
      });
    row((kind + ", pixels").c_str(), repeat, expected,
      [&]
      {
        Lattice lattice;
        lattice.Delta = { 1.0 / pixels, 1.0 / pixels, 1 };
        lattice.Min = { 0.5 / pixels, 0.5 / pixels, 0 };
        lattice.Extent = { 0, pixels - 1, 0, pixels - 1, 0, 0 };
        OverlapSums sums(std::int64_t(pixels) * pixels, 1);
        addPixels(lattice, *from, sums, threads, {});
        return sums;
      });
  }
  return 0;
}
