// SPDX-License-Identifier: BSD-3-Clause
// As in figure 4.12 of the dissertation: samples the whole domain of a partitioned mesh.
#include "ResampleSubjects.h"

#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPartitionedUnstructuredWriter.h"
#include "vtkRangeResampleFilter.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#include <cstdio>

#include <omp.h>

namespace tipp
{
namespace benchmark
{

namespace
{

constexpr int Sides[] = { 1, 2, 4, 8, 16 }; ///< number of partitions along an axis

void printTitle(const std::vector<int>& sampleSides)
{
  std::printf("| partitions |");
  for (const int side : sampleSides)
  {
    std::printf(" %d x %d samples in each |", side, side);
  }
  std::printf("\n|---|");
  for (std::size_t i = 0; i < sampleSides.size(); ++i)
  {
    std::printf("---|");
  }
  std::printf("\n");
}

/// Partitions the mesh and reads the pieces, so that they are in memory as a reader makes them.
vtkSmartPointer<vtkDataObject> pieces(vtkUnstructuredGrid* grid, const std::string& path, int side)
{
  vtkNew<vtkPartitionedUnstructuredWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(path.c_str());
  const std::string tiling = "grid:" + std::to_string(side) + "x" + std::to_string(side);
  writer->SetTiling(tiling.c_str());
  writer->Write();
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetFileName(path.c_str());
  reader->MergePiecesOff();
  reader->Update();
  return reader->GetOutputDataObject(0);
}

double sample(vtkDataObject* mesh, int samples, int device, int threads, int repeat)
{
  Best best;
  for (int i = 0; i < repeat; ++i)
  {
    vtkNew<vtkRangeResampleFilter> filter;
    filter->SetInputDataObject(mesh);
    filter->SetSamplingDimensions(samples, samples, 1);
    filter->SetDevice(device);
    filter->SetNumberOfThreads(threads);
    const double begin = seconds();
    filter->Update();
    best.take(seconds() - begin, hitsOf(filter->GetOutput()));
  }
  return best.Seconds;
}

} // namespace

void benchmarkPartitions(const std::vector<std::string>& arguments)
{
  const auto mesh = surface("uniform", std::stoll(arguments.at(1)));
  addArrays(mesh);
  const auto grid = asGrid(mesh);
  const int repeat = std::stoi(arguments.at(2));
  std::vector<int> sampleSides;
  for (int side = 32; side <= std::stoi(arguments.at(3)); side *= 2)
  {
    sampleSides.push_back(side);
  }
  const bool device = arguments.size() > 4;
  std::printf("%lld triangles; one thread's seconds, %d threads' speed-up%s\n\n",
    static_cast<long long>(grid->GetNumberOfCells()), omp_get_max_threads(),
    device ? ", the OpenCL device's" : "");
  printTitle(sampleSides);
  const auto row = [&](vtkDataObject* parts, int side)
  {
    for (const int samples : sampleSides)
    {
      const auto run = [&](int kind, int threads)
      { return sample(parts, side * samples, kind, threads, repeat); };
      const double one = run(vtkRangeResampleFilter::DEVICE_OPENMP, 1);
      std::printf(" %.3f s, %.2fx", one, one / run(vtkRangeResampleFilter::DEVICE_OPENMP, 0));
      if (device)
      {
        std::printf(", %.2fx", one / run(vtkRangeResampleFilter::DEVICE_OPENCL, 0));
      }
      std::printf(" |");
      std::fflush(stdout);
    }
    std::printf("\n");
  };
  for (const int side : Sides)
  {
    const auto parts = pieces(grid, arguments.at(0) + "/partitions.tipp", side);
    std::printf("| %d x %d |", side, side);
    row(parts, side);
    if (side == 1)
    {
      std::printf("| 1 x 1, as many samples as of 16 x 16 |");
      row(parts, 16);
    }
  }
}

} // namespace benchmark
} // namespace tipp
