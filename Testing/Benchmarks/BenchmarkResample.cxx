// SPDX-License-Identifier: BSD-3-Clause
// vtkRangeResampleFilter beside vtkProbeFilter, taking turns in one process; see
// Utilities/benchmarks/resample.sh. Arguments: CASE POINTS SAMPLES-PER-AXIS REPEAT FRACTION
// [opencl].
#include "vtkRangeResampleFilter.h"
#include "vtkTIPPDelaunay2D.h"

#include "Distributions/GeneratePoints.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProbeFilter.h"
#include "vtkSMPTools.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <omp.h>
#include <sys/resource.h>

namespace
{

double seconds()
{
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

double peakMegabytes()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024;
}

void addArrays(vtkPointSet* mesh)
{
  for (const char* name : { "height", "wave" })
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfValues(mesh->GetNumberOfPoints());
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      double p[3];
      mesh->GetPoint(i, p);
      array->SetValue(i, name[0] == 'h' ? p[0] - 2 * p[1] + p[2] : std::sin(30 * p[0]) * p[1]);
    }
    mesh->GetPointData()->AddArray(array);
  }
}

/// A triangulation of points of a distribution; "local" points are those of a jittered lattice, row
/// by row.
vtkSmartPointer<vtkPointSet> surface(const std::string& kind, vtkIdType count)
{
  std::vector<double> xy;
  if (kind == "local")
  {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    const vtkIdType side = vtkIdType(std::sqrt(double(count)));
    for (vtkIdType i = 0; i < count; ++i)
    {
      xy.push_back((double(i % side) + unit(random)) / double(side));
      xy.push_back((double(i / side) + unit(random)) / double(side));
    }
  }
  else
  {
    xy = tipp::generatePoints(
      kind == "clustered" ? tipp::Distribution::Clustered : tipp::Distribution::Uniform, count, 1);
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, xy[std::size_t(2 * i)], xy[std::size_t(2 * i + 1)], 0);
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->Update();
  return delaunay->GetOutput();
}

/// A jittered lattice cut into six tetrahedra a cube.
vtkSmartPointer<vtkPointSet> volume(vtkIdType count)
{
  const int side = int(std::lround(std::cbrt(double(count))));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> offset(-0.15, 0.15);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int z = 0; z < side; ++z)
  {
    for (int y = 0; y < side; ++y)
    {
      for (int x = 0; x < side; ++x)
      {
        const auto moved = [&](int i)
        { return (i + (i == 0 || i == side - 1 ? 0 : offset(random))) / (side - 1); };
        const double px = moved(x);
        const double py = moved(y);
        points->InsertNextPoint(px, py, moved(z));
      }
    }
  }
  vtkNew<vtkIdTypeArray> ids;
  const vtkIdType strides[3] = { 1, side, vtkIdType(side) * side };
  for (vtkIdType cube = 0; cube < vtkIdType(side - 1) * (side - 1) * (side - 1); ++cube)
  {
    const vtkIdType x = cube % (side - 1);
    const vtkIdType y = cube / (side - 1) % (side - 1);
    const vtkIdType z = cube / (side - 1) / (side - 1);
    int axes[3] = { 0, 1, 2 };
    do
    {
      vtkIdType corner = x + y * strides[1] + z * strides[2];
      ids->InsertNextValue(corner);
      for (const int axis : axes)
      {
        corner += strides[axis];
        ids->InsertNextValue(corner);
      }
    } while (std::next_permutation(axes, axes + 3));
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(4, ids);
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(VTK_TETRA, cells);
  return grid;
}

struct Best
{
  double Seconds = HUGE_VAL;
  vtkIdType Hits = 0;

  void take(double time, vtkIdType hits)
  {
    this->Seconds = std::min(this->Seconds, time);
    this->Hits = hits;
  }
};

vtkIdType hitsOf(vtkDataSet* image)
{
  vtkDataArray* const mask = image->GetPointData()->GetArray("vtkValidPointMask");
  vtkIdType hits = 0;
  for (vtkIdType i = 0; i < mask->GetNumberOfTuples(); ++i)
  {
    hits += mask->GetComponent(i, 0) != 0;
  }
  return hits;
}

void ours(vtkPointSet* mesh, const double* bounds, const int* dimensions, int device, Best& best,
  vtkImageData* image)
{
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputData(mesh);
  filter->UseInputBoundsOff();
  filter->SetSamplingBounds(bounds);
  filter->SetSamplingDimensions(dimensions);
  filter->SetDevice(device);
  const double begin = seconds();
  filter->Update();
  best.take(seconds() - begin, hitsOf(filter->GetOutput()));
  image->ShallowCopy(filter->GetOutput());
}

void theirs(vtkPointSet* mesh, vtkImageData* like, Best& best)
{
  vtkNew<vtkImageData> image;
  image->CopyStructure(like);
  vtkNew<vtkProbeFilter> probe;
  probe->SetInputData(image);
  probe->SetSourceData(mesh);
  const double begin = seconds();
  probe->Update();
  best.take(seconds() - begin, hitsOf(probe->GetOutput()));
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 6 && argc != 7)
  {
    std::fprintf(stderr, "benchmarkResample CASE POINTS SAMPLES REPEAT FRACTION [opencl]\n");
    return 2;
  }
  const std::string kind = argv[1];
  const int samples = std::atoi(argv[3]);
  const int repeat = std::atoi(argv[4]);
  const bool space = kind == "tetrahedra";
  const auto mesh = space ? volume(std::atoll(argv[2])) : surface(kind, std::atoll(argv[2]));
  addArrays(mesh);
  // A part of the mesh's box, in its middle, of so large an area or volume.
  const double side = std::pow(std::atof(argv[5]), space ? 1.0 / 3 : 0.5);
  double bounds[6];
  mesh->GetBounds(bounds);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double middle = (bounds[2 * axis] + bounds[2 * axis + 1]) / 2;
    const double half = (bounds[2 * axis + 1] - bounds[2 * axis]) / 2 * side;
    bounds[2 * axis] = middle - half;
    bounds[2 * axis + 1] = middle + half;
  }
  const int dimensions[3] = { samples, samples, space ? samples : 1 };
  Best us;
  Best device;
  Best peer;
  vtkNew<vtkImageData> image;
  const double before = peakMegabytes();
  ours(mesh, bounds, dimensions, vtkRangeResampleFilter::DEVICE_OPENMP, us, image);
  const double extra = peakMegabytes() - before;
  for (int i = 0; i < repeat; ++i)
  {
    theirs(mesh, image, peer);
    ours(mesh, bounds, dimensions, vtkRangeResampleFilter::DEVICE_OPENMP, us, image);
    if (argc == 7)
    {
      ours(mesh, bounds, dimensions, vtkRangeResampleFilter::DEVICE_OPENCL, device, image);
    }
  }
  std::printf(
    "| %s, %lld cells, %d per axis, %g of the box | %d and %d | %.4f s | %.4f s | %.1fx | "
    "%lld and %lld | %.0f MB |",
    kind.c_str(), static_cast<long long>(mesh->GetNumberOfCells()), samples, std::atof(argv[5]),
    omp_get_max_threads(), vtkSMPTools::GetEstimatedNumberOfThreads(), us.Seconds, peer.Seconds,
    peer.Seconds / us.Seconds, static_cast<long long>(us.Hits), static_cast<long long>(peer.Hits),
    extra);
  if (argc == 7)
  {
    std::printf(" %.4f s, %.2fx |", device.Seconds, device.Seconds / us.Seconds);
  }
  std::printf("\n");
  return 0;
}
