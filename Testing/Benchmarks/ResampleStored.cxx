// SPDX-License-Identifier: BSD-3-Clause
#include "ResampleSubjects.h"

#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPartitionedUnstructuredWriter.h"
#include "vtkRangeResampleFilter.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkProbeFilter.h"
#include "vtkSMPTools.h"
#include "vtkXMLUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <cstdio>

#include <omp.h>

namespace tipp
{
namespace benchmark
{

namespace
{

struct Paths
{
  std::string Vtu;
  std::string Partitioned;
};

/// The same mesh in both forms: raw, uncompressed, and so that many pieces are small.
Paths store(const std::string& folder, vtkIdType points, double* bounds)
{
  const Paths paths = { folder + "/stored.vtu", folder + "/stored.tipp" };
  const auto mesh = surface("uniform", points);
  addArrays(mesh);
  mesh->GetBounds(bounds);
  const auto grid = asGrid(mesh);
  vtkNew<vtkXMLUnstructuredGridWriter> file;
  file->SetInputData(grid);
  file->SetFileName(paths.Vtu.c_str());
  file->SetDataModeToAppended();
  file->EncodeAppendedDataOff();
  file->SetCompressorTypeToNone();
  file->Write();
  vtkNew<vtkPartitionedUnstructuredWriter> pieces;
  pieces->SetInputData(grid);
  pieces->SetFileName(paths.Partitioned.c_str());
  pieces->SetTiling("grid:16x16");
  pieces->Write();
  return paths;
}

vtkSmartPointer<vtkImageData> ours(
  const std::string& path, const double* bounds, int samples, Best& best)
{
  const double begin = seconds();
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetBounds(bounds);
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputConnection(reader->GetOutputPort());
  filter->UseInputBoundsOff();
  filter->SetSamplingBounds(bounds);
  filter->SetSamplingDimensions(samples, samples, 1);
  filter->SetDevice(vtkRangeResampleFilter::DEVICE_OPENMP);
  filter->Update();
  best.take(seconds() - begin, hitsOf(filter->GetOutput()));
  return filter->GetOutput();
}

/// The seconds of reading alone come back.
double theirs(const std::string& path, vtkImageData* like, Best& best)
{
  vtkNew<vtkImageData> image;
  image->CopyStructure(like);
  const double begin = seconds();
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  const double read = seconds() - begin;
  vtkNew<vtkProbeFilter> probe;
  probe->SetInputData(image);
  probe->SetSourceConnection(reader->GetOutputPort());
  probe->Update();
  best.take(seconds() - begin, hitsOf(probe->GetOutput()));
  return read;
}

} // namespace

void benchmarkStored(const std::vector<std::string>& arguments)
{
  double bounds[6];
  const vtkIdType points = std::stoll(arguments.at(1));
  const Paths paths = store(arguments.at(0), points, bounds);
  const int samples = std::stoi(arguments.at(2));
  const double fraction = std::stod(arguments.at(4));
  const std::array<double, 6> range = middleOf(bounds, std::sqrt(fraction));
  Best us;
  Best peer;
  double read = HUGE_VAL;
  for (int i = 0; i < std::stoi(arguments.at(3)); ++i)
  {
    const auto image = ours(paths.Partitioned, range.data(), samples, us);
    read = std::min(read, theirs(paths.Vtu, image, peer));
  }
  std::printf(
    "| partitioned mesh of %lld uniform points, 16 x 16 pieces, %d per axis, %g of the box, "
    "beside reading a .vtu (%.3f s of it) and probing | %d and %d | %.4f s | %.4f s | "
    "%.1fx | %lld and %lld | |\n",
    static_cast<long long>(points), samples, fraction, read, omp_get_max_threads(),
    vtkSMPTools::GetEstimatedNumberOfThreads(), us.Seconds, peer.Seconds, peer.Seconds / us.Seconds,
    static_cast<long long>(us.Hits), static_cast<long long>(peer.Hits));
}

} // namespace benchmark
} // namespace tipp
