// SPDX-License-Identifier: BSD-3-Clause
// Compares vtkRangeResampleFilter with vtkProbeFilter, alternately in one process; see
// Utilities/benchmarks/resample.sh. Arguments: CASE POINTS SAMPLES-PER-AXIS REPEAT FRACTION
// [opencl].
#include "ResampleSubjects.h"

#include "vtkRangeResampleFilter.h"

#include "Vtk/DataSets.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkProbeFilter.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <omp.h>
#include <sys/resource.h>

using namespace tipp::benchmark;

namespace
{

double peakMegabytes()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024;
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

/// Seconds of checking the input, which ours() does once per mesh: the fastest of `repeat` runs.
double checkSeconds(vtkPointSet* mesh, int repeat)
{
  double fastest = HUGE_VAL;
  for (int i = 0; i < repeat; ++i)
  {
    mesh->Modified(); // otherwise it would not be checked again
    const double begin = seconds();
    tipp::checkCells(mesh, "the input");
    tipp::allPointsFinite(mesh);
    fastest = std::min(fastest, seconds() - begin);
  }
  return fastest;
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
  const std::vector<std::string> rest(argv + std::min(argc, 2), argv + argc);
  if (argc == 7 && argv[1] == std::string("stored"))
  {
    benchmarkStored(rest);
    return 0;
  }
  if ((argc == 6 || argc == 7) && argv[1] == std::string("partitions"))
  {
    benchmarkPartitions(rest);
    return 0;
  }
  if (argc != 6 && argc != 7)
  {
    std::fprintf(stderr,
      "benchmarkResample CASE POINTS SAMPLES REPEAT FRACTION [opencl]\n"
      "benchmarkResample stored FOLDER POINTS SAMPLES REPEAT FRACTION\n"
      "benchmarkResample partitions FOLDER POINTS REPEAT SAMPLES [opencl]\n");
    return 2;
  }
  const std::string kind = argv[1];
  const int samples = std::atoi(argv[3]);
  const int repeat = std::atoi(argv[4]);
  const bool space = kind == "tetrahedra";
  const auto mesh = space ? volume(std::atoll(argv[2])) : surface(kind, std::atoll(argv[2]));
  addArrays(mesh);
  // The side of a range with this fraction of the area or volume.
  const double side = std::pow(std::atof(argv[5]), space ? 1.0 / 3 : 0.5);
  const std::array<double, 6> bounds = middleOf(mesh->GetBounds(), side);
  const int dimensions[3] = { samples, samples, space ? samples : 1 };
  Best us;
  Best device;
  Best peer;
  vtkNew<vtkImageData> image;
  const double before = peakMegabytes();
  ours(mesh, bounds.data(), dimensions, vtkRangeResampleFilter::DEVICE_OPENMP, us, image);
  const double extra = peakMegabytes() - before;
  for (int i = 0; i < repeat; ++i)
  {
    theirs(mesh, image, peer);
    ours(mesh, bounds.data(), dimensions, vtkRangeResampleFilter::DEVICE_OPENMP, us, image);
    if (argc == 7)
    {
      ours(mesh, bounds.data(), dimensions, vtkRangeResampleFilter::DEVICE_OPENCL, device, image);
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
  const double check = checkSeconds(mesh, std::max(repeat, 10));
  std::printf(
    "| check of the input | | %.4f s | | %.1f %% of ours | | |\n", check, 100 * check / us.Seconds);
  return 0;
}
