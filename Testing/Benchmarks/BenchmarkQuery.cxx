// SPDX-License-Identifier: BSD-3-Clause
// Queries beside vtkProbeFilter, vtkContourFilter and resampling; see
// Utilities/benchmarks/query.sh. Arguments: memory POINTS QUERIES REPEAT [peers], or stored MESH
// QUERIES MEGABYTES.
#include "ResampleSubjects.h"

#include "Query/Around.h"
#include "Query/DataSetPart.h"
#include "Query/Lines.h"
#include "Query/ResidentMesh.h"
#include "vtkPartitionedMeshQuery.h"
#include "vtkRangeResampleFilter.h"

#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProbeFilter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <sys/resource.h>

using namespace tipp;
using namespace tipp::benchmark;

namespace
{

double processorSeconds()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& time)
  { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

/// Prints the fastest of some runs; `work` returns what it found.
void row(const std::string& name, int repeat, const std::function<std::int64_t()>& work)
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
  for (std::int64_t i = 0; i < count; ++i)
  {
    points.push_back({ x(random), y(random), 0 });
  }
  return points;
}

/// The samples of a grid, row by row.
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

void benchmarkMemory(std::int64_t count, std::int64_t queries, int repeat, bool withPeers)
{
  const vtkSmartPointer<vtkPointSet> mesh = surface("uniform", count);
  addArrays(mesh);
  std::vector<std::string> names;
  for (int i = 0; i < mesh->GetPointData()->GetNumberOfArrays(); ++i)
  {
    names.emplace_back(mesh->GetPointData()->GetArrayName(i));
  }
  std::printf("%lld triangles, %lld points, two arrays\n\n| what | time | processor | found |\n"
              "|---|---|---|---|\n",
    static_cast<long long>(mesh->GetNumberOfCells()), static_cast<long long>(queries));
  double bounds[6];
  mesh->GetBounds(bounds);
  const std::vector<Point3> asked = scattered(queries, bounds);
  AnswerOptions options;
  options.Arrays = names;
  row("scattered points, with the locator", repeat,
    [&]
    {
      const ResidentMesh resident(partOf(mesh, 0));
      return hits(resident.answer(asked.data(), queries, options));
    });
  const ResidentMesh resident(partOf(mesh, 0));
  resident.answer(asked.data(), queries, options);
  row("scattered points, once more", repeat,
    [&] { return hits(resident.answer(asked.data(), queries, options)); });
  const int side = int(std::sqrt(double(queries)));
  const std::vector<Point3> ordered = inOrder(side, bounds);
  row("points in order", repeat,
    [&] { return hits(resident.answer(ordered.data(), std::int64_t(ordered.size()), options)); });
  row("a grid of as many samples, resampled", repeat,
    [&]
    {
      vtkNew<vtkRangeResampleFilter> filter;
      filter->SetInputData(mesh);
      filter->SetDevice(vtkRangeResampleFilter::DEVICE_OPENMP);
      filter->SetSamplingDimensions(side, side, 1);
      filter->Update();
      return std::int64_t(hitsOf(filter->GetOutput()));
    });
  std::vector<std::int64_t> ids;
  for (std::int64_t i = 0; i < std::min<std::int64_t>(1000000, count); ++i)
  {
    ids.push_back(i);
  }
  neighborsOf(resident, { 0 });
  row(std::to_string(ids.size()) + " one-rings of points", repeat,
    [&] { return std::int64_t(ringsOfPoints(resident, ids, 1).Ids.size()); });
  row("neighbours of as many cells", repeat,
    [&] { return std::int64_t(neighborsOf(resident, ids).size()); });
  std::vector<double> levels;
  double range[2];
  mesh->GetPointData()->GetArray(0)->GetRange(range);
  for (int i = 1; i <= 10; ++i)
  {
    levels.push_back(range[0] + (range[1] - range[0]) * i / 11);
  }
  row("contours of ten levels", repeat,
    [&] { return std::int64_t(contoursOf(resident, names[0], 0, levels).Points.size()); });
  if (!withPeers)
  {
    return;
  }
  row("vtkContourFilter", 1,
    [&]
    {
      vtkNew<vtkContourFilter> filter;
      filter->SetInputData(mesh);
      filter->SetInputArrayToProcess(
        0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, names[0].c_str());
      for (std::size_t i = 0; i < levels.size(); ++i)
      {
        filter->SetValue(int(i), levels[i]);
      }
      filter->Update();
      return std::int64_t(filter->GetOutput()->GetNumberOfPoints());
    });
  const vtkSmartPointer<vtkPolyData> input = asPolyData(asked);
  row("vtkPartitionedMeshQuery, with its locator", 1,
    [&]
    {
      vtkNew<vtkPartitionedMeshQuery> query;
      query->SetInputData(input);
      query->SetSourceData(mesh);
      query->Update();
      return std::int64_t(hitsOf(vtkDataSet::SafeDownCast(query->GetOutput())));
    });
  row("vtkProbeFilter, with its locator", 1,
    [&]
    {
      vtkNew<vtkProbeFilter> probe;
      probe->SetInputData(input);
      probe->SetSourceData(mesh);
      probe->Update();
      return std::int64_t(hitsOf(probe->GetOutput()));
    });
}

void benchmarkStored(const std::string& path, std::int64_t queries, std::uint64_t megabytes)
{
  ResidentOptions options;
  options.MemoryLimit = megabytes << 20;
  const ResidentMesh mesh(path, options);
  std::printf(
    "%lld cells in %zu pieces, %lld points, %llu MB\n\n| what | time | processor | found |\n"
    "|---|---|---|---|\n",
    static_cast<long long>(mesh.mesh().Cells), mesh.mesh().Pieces.size(),
    static_cast<long long>(queries), static_cast<unsigned long long>(megabytes));
  const Bounds& domain = mesh.mesh().Domain;
  const std::vector<Point3> everywhere = scattered(queries, domain.data());
  row("random points", 1, [&] { return hits(mesh.answer(everywhere.data(), queries)); });
  const double region[4] = { domain[0] + 0.40 * (domain[1] - domain[0]),
    domain[0] + 0.42 * (domain[1] - domain[0]), domain[2] + 0.40 * (domain[3] - domain[2]),
    domain[2] + 0.42 * (domain[3] - domain[2]) };
  const std::vector<Point3> near = scattered(queries, region);
  row("points of one region, 2 % of each side", 3,
    [&] { return hits(mesh.answer(near.data(), queries)); });
  if (!mesh.mesh().Arrays.empty() || mesh.mesh().CellSize == 3)
  {
    const std::string name = mesh.names().front();
    row("contours of ten levels", 1,
      [&]
      {
        std::vector<double> levels;
        for (int i = 1; i <= 10; ++i)
        {
          levels.push_back(domain[4] + (domain[5] - domain[4]) * i / 11);
        }
        return std::int64_t(contoursOf(mesh, name, 0, levels).Points.size());
      });
  }
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("\npeak memory %ld MB, %lld pieces loaded\n", usage.ru_maxrss / 1024,
    static_cast<long long>(mesh.pieces().loads()));
}

} // namespace

int main(int argc, char* argv[])
{
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "memory" && argc >= 5)
  {
    benchmarkMemory(std::atoll(argv[2]), std::atoll(argv[3]), std::atoi(argv[4]),
      argc > 5 && argv[5] == std::string("peers"));
    return 0;
  }
  if (what == "stored" && argc == 5)
  {
    benchmarkStored(argv[2], std::atoll(argv[3]), std::strtoull(argv[4], nullptr, 10));
    return 0;
  }
  std::fprintf(stderr,
    "benchmarkQuery memory POINTS QUERIES REPEAT [peers]\n"
    "benchmarkQuery stored MESH QUERIES MEGABYTES\n");
  return 2;
}
