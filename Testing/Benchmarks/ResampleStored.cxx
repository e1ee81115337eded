// SPDX-License-Identifier: BSD-3-Clause
#include "ResampleSubjects.h"

#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPartitionedUnstructuredWriter.h"
#include "vtkRangeResampleFilter.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
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

/// Writes the same mesh as an uncompressed raw .vtu, and as a partitioned mesh of many small
/// pieces.
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

/// Seconds of reading and of the whole run, and the image.
struct Run
{
  double Read;
  double All;
  vtkSmartPointer<vtkImageData> Image;
};

Run ours(const std::string& path, const double* bounds, int samples)
{
  const double begin = seconds();
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetBounds(bounds);
  reader->Update();
  const double read = seconds() - begin;
  // Removes the ids, so that the mesh has the same arrays as the .vtu.
  vtkNew<vtkUnstructuredGrid> mesh;
  mesh->ShallowCopy(reader->GetOutputDataObject(0));
  mesh->GetPointData()->RemoveArray("GlobalPointIds");
  mesh->GetCellData()->RemoveArray("GlobalCellIds");
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputData(mesh);
  filter->UseInputBoundsOff();
  filter->SetSamplingBounds(bounds);
  filter->SetSamplingDimensions(samples, samples, 1);
  filter->SetDevice(vtkRangeResampleFilter::DEVICE_OPENMP);
  filter->Update();
  return { read, seconds() - begin, filter->GetOutput() };
}

Run theirs(const std::string& path, vtkImageData* like)
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
  return { read, seconds() - begin, vtkImageData::SafeDownCast(probe->GetOutput()) };
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
  Best us[2];
  Best peer[2];
  for (int i = 0; i < std::stoi(arguments.at(3)); ++i)
  {
    const Run our = ours(paths.Partitioned, range.data(), samples);
    const Run their = theirs(paths.Vtu, our.Image);
    us[0].take(our.Read, 0);
    us[1].take(our.All, hitsOf(our.Image));
    peer[0].take(their.Read, 0);
    peer[1].take(their.All, hitsOf(their.Image));
  }
  std::printf(
    "| partitioned mesh of %lld uniform points, 16 x 16 pieces, %d per axis, %g of the box, "
    "beside reading a .vtu and probing it; of it reading %.4f s and %.4f s | %d and %d | "
    "%.4f s | %.4f s | %.1fx | %lld and %lld | |\n",
    static_cast<long long>(points), samples, fraction, us[0].Seconds, peer[0].Seconds,
    omp_get_max_threads(), vtkSMPTools::GetEstimatedNumberOfThreads(), us[1].Seconds,
    peer[1].Seconds, peer[1].Seconds / us[1].Seconds, static_cast<long long>(us[1].Hits),
    static_cast<long long>(peer[1].Hits));
}

} // namespace benchmark
} // namespace tipp
