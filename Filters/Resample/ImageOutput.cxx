// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/ImageOutput.h"

#include "Arrays/ScalarTypes.h"
#include "Parallel/ForChunks.h"

#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

#include <unistd.h>

namespace tipp
{
namespace
{

/// The bytes of one sample of all selected arrays.
double bytesOfArrays(const std::vector<vtkPointSet*>& meshes, const SamplingSettings& settings)
{
  double bytes = 0;
  std::set<std::string> counted;
  const auto count = [&](vtkDataSetAttributes* data, bool ofCells)
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* const array = data->GetArray(i);
      if (array && array->GetName() && settings.Selected(ofCells, array->GetName()) &&
        counted.insert(array->GetName()).second)
      {
        bytes += array->GetNumberOfComponents() * array->GetDataTypeSize();
      }
    }
  };
  for (vtkPointSet* mesh : meshes)
  {
    count(mesh->GetPointData(), false);
    count(mesh->GetCellData(), true);
  }
  return bytes;
}

/// Fills the mask and the points' ghosts; how many samples are valid.
std::int64_t fillPoints(
  const std::vector<unsigned char>& valid, int threads, char* mask, unsigned char* ghosts)
{
  std::vector<std::int64_t> counts(std::size_t(threads), 0);
  forChunks(std::int64_t(valid.size()), 1 << 16, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        mask[i] = char(valid[std::size_t(i)]);
        ghosts[i] = valid[std::size_t(i)] ? 0 : vtkDataSetAttributes::HIDDENPOINT;
      }
      counts[std::size_t(thread)] += std::count(valid.begin() + begin, valid.begin() + end, 1);
    });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
}

void fillCellGhosts(const std::vector<unsigned char>& valid, int threads, vtkImageData* image)
{
  vtkUnsignedCharArray* const cells = image->AllocateCellGhostArray();
  int dimensions[3];
  image->GetDimensions(dimensions);
  const std::int64_t width = dimensions[0];
  const std::int64_t layer = width * dimensions[1];
  const int columns = std::max(1, dimensions[0] - 1);
  const int rows = std::max(1, dimensions[1] - 1);
  const int layers = std::max(1, dimensions[2] - 1);
  const std::int64_t steps[3] = { dimensions[0] > 1 ? 1 : 0, dimensions[1] > 1 ? width : 0,
    dimensions[2] > 1 ? layer : 0 };
  unsigned char* const first = cells->GetPointer(0);
  const auto fillRow = [&](std::int64_t row)
  {
    const unsigned char* corner = valid.data() + row / rows * layer + row % rows * width;
    for (unsigned char* cell = first + row * columns; cell < first + (row + 1) * columns;
         ++cell, ++corner)
    {
      const auto edge = [&](std::int64_t from) { return corner[from] & corner[from + steps[0]]; };
      const bool whole = edge(0) & edge(steps[1]) & edge(steps[2]) & edge(steps[1] + steps[2]);
      *cell = whole ? 0 : vtkDataSetAttributes::HIDDENCELL;
    }
  };
  forChunks(std::int64_t(rows) * layers, 64, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (std::int64_t row = begin; row < end; ++row)
      {
        fillRow(row);
      }
    });
}

} // namespace

void refuseTooLarge(const Lattice& local, const Lattice& wanted, bool exchanging,
  const std::vector<vtkPointSet*>& meshes, const SamplingSettings& settings)
{
  // The claims, the mask and the two arrays of the output that go with it.
  constexpr double claims = 4;
  constexpr double mask = 4;
  const double arrays = bytesOfArrays(meshes, settings) + mask;
  const double keys = settings.Merging ? sizeof(CellKey) : 0;
  const auto count = [](const Lattice& lattice)
  {
    return lattice.empty()
      ? 0.0
      : double(lattice.size(0)) * double(lattice.size(1)) * double(lattice.size(2));
  };
  const double needed =
    count(local) * (arrays + claims + keys) + (exchanging ? count(wanted) * (arrays + keys) : 0);
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (needed > memory)
  {
    char text[256];
    std::snprintf(text, sizeof text,
      "%.0f samples need at least %.1f GB of memory, and this machine has %.1f GB: use a smaller "
      "range, fewer samples or fewer arrays.",
      std::max(count(local), count(wanted)), needed / 1e9, memory / 1e9);
    throw std::runtime_error(text);
  }
}

std::int64_t fillImage(SampledImage& samples, int threads, vtkImageData* image)
{
  Lattice lattice = samples.lattice();
  image->SetExtent(lattice.Extent.data());
  image->SetOrigin(lattice.Min.data());
  image->SetSpacing(lattice.Delta.data());
  vtkPointData* const data = image->GetPointData();
  for (const SampledImage::Array& array : samples.arrays())
  {
    data->AddArray(array.Samples);
  }
  std::vector<unsigned char>& valid = samples.valid();
  vtkNew<vtkCharArray> mask;
  mask->SetName("vtkValidPointMask");
  mask->SetNumberOfValues(vtkIdType(valid.size()));
  data->AddArray(mask);
  if (lattice.empty())
  {
    return 0;
  }
  fillCellGhosts(valid, threads, image);
  return fillPoints(
    valid, threads, mask->GetPointer(0), image->AllocatePointGhostArray()->GetPointer(0));
}

void fillTable(const SamplingReport& report, vtkTable* table)
{
  table->Initialize();
  vtkFieldData* const data = table->GetFieldData();
  const auto number = [&](const char* name, std::int64_t value)
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    data->AddArray(array);
  };
  const SamplingStatistics& statistics = report.Statistics;
  number("Cells", statistics.Cells);
  number("IgnoredCells", statistics.Ignored);
  number("VisitedCells", statistics.Claims.VisitedCells);
  number("Tests", statistics.Claims.Tests);
  number("ExactTests", statistics.Claims.ExactTests);
  number("OverlappingClaims", statistics.Claims.OverlappingClaims);
  number("Samples", report.Samples);
  number("SamplesHit", report.Hits);
  number("Threads", report.Threads);
  vtkNew<vtkStringArray> device;
  device->SetName("Device");
  device->InsertNextValue(statistics.Device);
  data->AddArray(device);
  vtkNew<vtkStringArray> names;
  vtkNew<vtkDoubleArray> seconds;
  names->SetName("PhaseName");
  seconds->SetName("PhaseSeconds");
  const auto phase = [&](const char* name, double value)
  {
    names->InsertNextValue(name);
    seconds->InsertNextValue(value);
  };
  phase("preparation", statistics.PreparationSeconds);
  phase("claims", statistics.ClaimSeconds);
  phase("interpolation", statistics.InterpolationSeconds);
  phase("transfer", statistics.TransferSeconds);
  phase("exchange", report.ExchangeSeconds);
  phase("output", report.OutputSeconds);
  data->AddArray(names);
  data->AddArray(seconds);
}

} // namespace tipp
