// SPDX-License-Identifier: BSD-3-Clause
// Compares queries with vtkProbeFilter, vtkContourFilter and resampling; see
// Utilities/benchmarks/query.sh. Arguments: 'probe', 'order' or 'rings', then POINTS QUERIES
// REPEAT; 'contours' POINTS REPEAT; 'stored' MESH QUERIES MEGABYTES; 'stored-contours' MESH
// MEGABYTES; or, also under mpirun, 'rank-rings' POINTS QUERIES REPEAT.
#include "ProcessorTime.h"
#include "ResampleSubjects.h"

#include "Query/Queries.h"
#include "Query/QueryData.h"
#include "Ranks/Communicator.h"
#include "Resident/ResidentMesh.h"
#include "vtkPartitionedMeshQuery.h"
#include "vtkRangeResampleFilter.h"
#include "vtkTIPPDelaunay2D.h"

#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProbeFilter.h"
#ifdef TIPP_USE_MPI
#include "vtkMPIController.h"
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <malloc.h>

using namespace tipp;
using namespace tipp::benchmark;

namespace
{

/// Prints and returns the time of the fastest of `repeat` runs. `work` returns the number of
/// results.
double row(const std::string& name, int repeat, const std::function<std::int64_t()>& work)
{
  double wall = HUGE_VAL;
  double processor = HUGE_VAL;
  std::int64_t found = 0;
  for (int i = 0; i < repeat; ++i)
  {
    const double begin = seconds();
    const double beginOfProcessor = processorSeconds();
    found = work();
    processor = std::min(processor, processorSeconds() - beginOfProcessor);
    wall = std::min(wall, seconds() - begin);
  }
  std::printf("| %s | %.3f s | %.3f s | %lld |\n", name.c_str(), wall, processor,
    static_cast<long long>(found));
  std::fflush(stdout);
  return wall;
}

void ratioRow(const std::string& name, double ratio)
{
  std::printf("| %s | %.1f times | | |\n", name.c_str(), ratio);
}

vtkSmartPointer<vtkPolyData> asPolyData(const std::vector<Point3>& points)
{
  vtkNew<vtkPoints> coordinates;
  coordinates->SetDataTypeToDouble();
  coordinates->SetNumberOfPoints(vtkIdType(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    coordinates->SetPoint(vtkIdType(i), points[i].x, points[i].y, points[i].z);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(coordinates);
  return data;
}

std::int64_t hits(const MeshAnswer& answer)
{
  return std::int64_t(answer.Cells.size()) -
    std::count(answer.Cells.begin(), answer.Cells.end(), -1);
}

std::vector<Point3> scattered(std::int64_t count, const double* bounds)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(bounds[0], bounds[1]);
  std::uniform_real_distribution<double> y(bounds[2], bounds[3]);
  std::vector<Point3> points;
  points.reserve(std::size_t(count));
  for (std::int64_t i = 0; i < count; ++i)
  {
    points.push_back({ x(random), y(random), 0 });
  }
  return points;
}

/// The points of a grid with `side` points along each axis, row by row.
std::vector<Point3> inOrder(int side, const double* bounds)
{
  std::vector<Point3> points;
  for (int j = 0; j < side; ++j)
  {
    for (int i = 0; i < side; ++i)
    {
      points.push_back({ bounds[0] + (bounds[1] - bounds[0]) * i / (side - 1),
        bounds[2] + (bounds[3] - bounds[2]) * j / (side - 1), 0 });
    }
  }
  return points;
}

/// A mesh of uniform points with two arrays in memory, and the rows of the table that query it.
class MemoryRows
{
public:
  explicit MemoryRows(std::int64_t points)
    : Mesh(surface("uniform", points))
  {
    addArrays(this->Mesh);
    for (int i = 0; i < this->Mesh->GetPointData()->GetNumberOfArrays(); ++i)
    {
      this->Options.Arrays.emplace_back(this->Mesh->GetPointData()->GetArrayName(i));
    }
    this->Mesh->GetBounds(this->Bounds);
    std::printf("%lld triangles, two arrays\n\n| what | time | processor | found |\n"
                "|---|---|---|---|\n",
      static_cast<long long>(this->Mesh->GetNumberOfCells()));
  }

  void probe(std::int64_t queries, int repeat) const
  {
    const std::vector<Point3> asked = scattered(queries, this->Bounds);
    const double first = row("scattered points, for the first time", repeat,
      [&]
      {
        const ResidentMesh resident(partOf(this->Mesh, 0));
        return hits(resident.answer(asked.data(), queries, this->Options));
      });
    const ResidentMesh resident(partOf(this->Mesh, 0));
    resident.answer(asked.data(), queries, this->Options);
    row("scattered points, once more", repeat,
      [&] { return hits(resident.answer(asked.data(), queries, this->Options)); });
    const vtkSmartPointer<vtkPolyData> input = asPolyData(asked);
    row("vtkPartitionedMeshQuery", 1,
      [&]
      {
        vtkNew<vtkPartitionedMeshQuery> query;
        query->SetInputData(input);
        query->SetSourceData(this->Mesh);
        query->Update();
        return std::int64_t(hitsOf(vtkDataSet::SafeDownCast(query->GetOutput())));
      });
    const double theirs = row("vtkProbeFilter, with its locator", 1,
      [&]
      {
        vtkNew<vtkProbeFilter> probe;
        probe->SetInputData(input);
        probe->SetSourceData(this->Mesh);
        probe->Update();
        return std::int64_t(hitsOf(probe->GetOutput()));
      });
    ratioRow("vtkProbeFilter over the first time", theirs / first);
  }

  void order(std::int64_t queries, int repeat) const
  {
    const int side = int(std::sqrt(double(queries)));
    const std::vector<Point3> ordered = inOrder(side, this->Bounds);
    const auto count = std::int64_t(ordered.size());
    const double first = row("points in order, for the first time", repeat,
      [&]
      {
        const ResidentMesh resident(partOf(this->Mesh, 0));
        return hits(resident.answer(ordered.data(), count, this->Options));
      });
    const ResidentMesh resident(partOf(this->Mesh, 0));
    resident.answer(ordered.data(), count, this->Options);
    row("points in order, once more", repeat,
      [&] { return hits(resident.answer(ordered.data(), count, this->Options)); });
    const double resampled = row("a grid of as many samples, resampled", repeat,
      [&]
      {
        vtkNew<vtkRangeResampleFilter> filter;
        filter->SetInputData(this->Mesh);
        filter->SetDevice(vtkRangeResampleFilter::DEVICE_OPENMP);
        filter->SetSamplingDimensions(side, side, 1);
        filter->Update();
        return std::int64_t(hitsOf(filter->GetOutput()));
      });
    ratioRow("the first time over resampling", first / resampled);
  }

  void rings(std::int64_t queries, int repeat) const
  {
    std::vector<std::int64_t> ids;
    for (std::int64_t i = 0; i < std::min(queries, std::int64_t(this->Mesh->GetNumberOfPoints()));
         ++i)
    {
      ids.push_back(i);
    }
    const ResidentMesh resident(partOf(this->Mesh, 0));
    neighborsOf(resident, { 0 });
    const std::string count = std::to_string(ids.size());
    row(count + " one-rings of points", repeat,
      [&] { return std::int64_t(ringsOfPoints(resident, ids, 1).Ids.size()); });
    row(count + " two-rings of points", repeat,
      [&] { return std::int64_t(ringsOfPoints(resident, ids, 2).Ids.size()); });
    row(count + " one-rings of cells", repeat,
      [&] { return std::int64_t(ringsOfCells(resident, ids, 1).Ids.size()); });
    row("neighbours of " + count + " cells", repeat,
      [&] { return std::int64_t(neighborsOf(resident, ids).size()); });
  }

  void contours(int repeat) const
  {
    const std::string& name = this->Options.Arrays[0];
    double range[2];
    this->Mesh->GetPointData()->GetArray(name.c_str())->GetRange(range);
    const std::vector<double> levels = tenLevels(range[0], range[1]);
    row("contours of ten levels", repeat,
      [&]
      {
        const ResidentMesh resident(partOf(this->Mesh, 0));
        return std::int64_t(contoursOf(resident, name, 0, levels).Points.size());
      });
    row("vtkContourFilter", 1,
      [&]
      {
        vtkNew<vtkContourFilter> filter;
        filter->SetInputData(this->Mesh);
        filter->SetInputArrayToProcess(
          0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name.c_str());
        for (std::size_t i = 0; i < levels.size(); ++i)
        {
          filter->SetValue(int(i), levels[i]);
        }
        filter->Update();
        return std::int64_t(filter->GetOutput()->GetNumberOfPoints());
      });
  }

  static std::vector<double> tenLevels(double low, double high)
  {
    std::vector<double> levels;
    for (int i = 1; i <= 10; ++i)
    {
      levels.push_back(low + (high - low) * i / 11);
    }
    return levels;
  }

private:
  vtkSmartPointer<vtkPointSet> Mesh;
  AnswerOptions Options;
  double Bounds[6];
};

/// The peak memory since the last call, in MB, or 0 if the system does not report it.
long peakMemory()
{
  std::ifstream status("/proc/self/status");
  long kilobytes = 0;
  for (std::string word; status >> word && kilobytes == 0;)
  {
    if (word == "VmHWM:")
    {
      status >> kilobytes;
    }
  }
  std::ofstream("/proc/self/clear_refs") << "5";
  return kilobytes / 1024;
}

void printPeak()
{
  std::printf("| its peak memory, %ld MB | | | |\n", peakMemory());
}

ResidentMesh openStored(const std::string& path, std::uint64_t megabytes)
{
  mallopt(M_MMAP_THRESHOLD, 1 << 20); // as in tipp query
  ResidentOptions options;
  options.MemoryLimit = megabytes << 20;
  return ResidentMesh(path, options);
}

void benchmarkStored(const std::string& path, std::int64_t queries, std::uint64_t megabytes)
{
  const ResidentMesh mesh = openStored(path, megabytes);
  std::printf(
    "%lld cells in %zu pieces, %lld points, %llu MB\n\n| what | time | processor | found |\n"
    "|---|---|---|---|\n",
    static_cast<long long>(mesh.mesh().Cells), mesh.mesh().Pieces.size(),
    static_cast<long long>(queries), static_cast<unsigned long long>(megabytes));
  const std::array<double, 6> domain = vtkBoundsOf(mesh.mesh().Domain);
  const std::vector<Point3> everywhere = scattered(queries, domain.data());
  peakMemory();
  row("random points", 1, [&] { return hits(mesh.answer(everywhere.data(), queries)); });
  printPeak();
  const double region[4] = { domain[0] + 0.40 * (domain[1] - domain[0]),
    domain[0] + 0.42 * (domain[1] - domain[0]), domain[2] + 0.40 * (domain[3] - domain[2]),
    domain[2] + 0.42 * (domain[3] - domain[2]) };
  const std::vector<Point3> near = scattered(queries, region);
  row("points of one region, 2 % of each side", 3,
    [&] { return hits(mesh.answer(near.data(), queries)); });
  printPeak();
}

void benchmarkStoredContours(const std::string& path, std::uint64_t megabytes)
{
  const ResidentMesh mesh = openStored(path, megabytes);
  const auto& [low, high] = mesh.mesh().Domain;
  const std::vector<double> levels = MemoryRows::tenLevels(low.z, high.z);
  row("contours of ten levels", 1,
    [&] { return std::int64_t(contoursOf(mesh, "elevation", 0, levels).Points.size()); });
  printPeak();
}

#ifdef TIPP_USE_MPI
/// Computes rings in a mesh of uniform points whose triangles are distributed over the ranks. Each
/// rank requests its share of the rings.
void benchmarkRankRings(
  vtkMPIController* controller, std::int64_t points, std::int64_t queries, int repeat)
{
  Communicator ranks(controller);
  const auto [firstPoint, lastPoint] = ranks.shareOf(points);
  std::vector<Point3> own;
  std::mt19937_64 random(std::uint64_t(ranks.rank()) + 1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::int64_t i = firstPoint; i < lastPoint; ++i)
  {
    const double x = unit(random);
    own.push_back({ x, unit(random), 0 });
  }
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetController(controller);
  delaunay->SetInputData(asPolyData(own));
  delaunay->Update();
  const ResidentMesh resident(partOf(delaunay->GetOutput(), 1));
  const auto [firstId, lastId] = ranks.shareOf(queries);
  // A rank's points and cells have consecutive ids, so the requested ids are spread over all.
  std::vector<std::int64_t> cells = { resident.mesh().Cells };
  ranks.sum(cells);
  const auto measure = [&, first = firstId, last = lastId](
                         const char* name, int k, std::int64_t count, const auto& rings)
  {
    std::vector<std::int64_t> ids;
    for (std::int64_t i = first; i < last; ++i)
    {
      ids.push_back(i * count / queries);
    }
    double wall = 1e300;
    std::int64_t found = 0;
    double processor = 1e300;
    const auto once = [&](bool counts)
    {
      ranks.barrier();
      const double begin = seconds();
      const double beginOfProcessor = processorSeconds();
      std::vector<std::int64_t> sums(2);
      sums[0] = std::int64_t(rings(resident, ids, k, &ranks).Ids.size());
      sums[1] = std::int64_t(1e6 * (processorSeconds() - beginOfProcessor));
      ranks.sum(sums);
      found = sums[0];
      wall = counts ? std::min(wall, seconds() - begin) : wall;
      processor = counts ? std::min(processor, 1e-6 * double(sums[1])) : processor;
    };
    for (int i = 0; i <= repeat; ++i)
    {
      ranks.together([&] { once(i > 0); }); // the first run prepares the mesh, and is not measured
    }
    if (ranks.isFirst())
    {
      std::printf("| %d | %s | %.3f s | %.3f s | %lld |\n", ranks.size(), name, wall, processor,
        static_cast<long long>(found));
    }
  };
  measure("one-rings of points", 1, points, ringsOfPoints);
  measure("two-rings of points", 2, points, ringsOfPoints);
  measure("one-rings of cells", 1, cells[0], ringsOfCells);
}
#endif

} // namespace

int main(int argc, char* argv[])
{
  const std::string what = argc > 1 ? argv[1] : "";
  const auto number = [&](int i) { return std::atoll(argv[i]); };
  if ((what == "probe" || what == "order" || what == "rings") && argc == 5)
  {
    const MemoryRows rows(number(2));
    const int repeat = int(number(4));
    what == "probe"     ? rows.probe(number(3), repeat)
      : what == "order" ? rows.order(number(3), repeat)
                        : rows.rings(number(3), repeat);
    return 0;
  }
  if (what == "contours" && argc == 4)
  {
    MemoryRows(number(2)).contours(int(number(3)));
    return 0;
  }
  if (what == "stored" && argc == 5)
  {
    benchmarkStored(argv[2], number(3), std::uint64_t(number(4)));
    return 0;
  }
  if (what == "stored-contours" && argc == 4)
  {
    benchmarkStoredContours(argv[2], std::uint64_t(number(3)));
    return 0;
  }
#ifdef TIPP_USE_MPI
  if (what == "rank-rings" && argc == 5)
  {
    vtkNew<vtkMPIController> controller;
    controller->Initialize(&argc, &argv);
    benchmarkRankRings(controller, number(2), number(3), int(number(4)));
    controller->Finalize();
    return 0;
  }
#endif
  std::fprintf(stderr,
    "benchmarkQuery probe|order|rings POINTS QUERIES REPEAT\n"
    "benchmarkQuery rank-rings POINTS QUERIES REPEAT\n"
    "benchmarkQuery contours POINTS REPEAT\n"
    "benchmarkQuery stored MESH QUERIES MEGABYTES\n"
    "benchmarkQuery stored-contours MESH MEGABYTES\n");
  return 2;
}
