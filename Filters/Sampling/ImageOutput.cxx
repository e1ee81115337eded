// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SampledImage.h"

#include "Arrays/Scalar.h"
#include "Output/RunStatistics.h"
#include "Parallel/ParallelFor.h"
#include "Sampling/SamplingLattice.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

namespace tipp
{
namespace
{

/// The number of bytes per sample of all selected arrays.
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

/// Adds an uninitialised ghost array for points or cells; `data` owns it.
unsigned char* addGhosts(vtkDataSetAttributes* data, std::int64_t count)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(vtkIdType(count));
  data->AddArray(ghosts);
  return ghosts->GetPointer(0);
}

// Separate functions, so that the compiler can assume that the bytes written alias nothing.

/// Marks invalid points as hidden. `count` must fit into a byte. Returns the number of valid
/// points.
unsigned char hidePoints(
  const unsigned char* valid, std::int64_t count, unsigned char* __restrict ghosts)
{
  unsigned char hits = 0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    ghosts[i] = (unsigned char)((valid[i] - 1) & vtkDataSetAttributes::HIDDENPOINT);
    hits = (unsigned char)(hits + valid[i]);
  }
  return hits;
}

/// Computes for each column whether the points of all four rows are valid.
void joinRows(
  const unsigned char* const (&rows)[4], std::int64_t count, unsigned char* __restrict valid)
{
  const unsigned char* const a = rows[0];
  const unsigned char* const b = rows[1];
  const unsigned char* const c = rows[2];
  const unsigned char* const d = rows[3];
  for (std::int64_t i = 0; i < count; ++i)
  {
    valid[i] = a[i] & b[i] & c[i] & d[i];
  }
}

/// Hides cells with invalid points; a cell's columns of points are `right` apart.
void hideCells(const unsigned char* valid, std::int64_t right, std::int64_t count,
  unsigned char* __restrict ghosts)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    const int whole = valid[i] & valid[i + right];
    ghosts[i] = (unsigned char)((whole - 1) & vtkDataSetAttributes::HIDDENCELL);
  }
}

/// Hides the points that are not valid. Returns the number of valid points.
std::int64_t fillPointGhosts(
  const unsigned char* valid, std::int64_t size, int threads, unsigned char* ghosts)
{
  std::vector<std::int64_t> counts(std::size_t(threads), 0);
  forChunks(size, 1 << 16, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      constexpr std::int64_t few = 1 << 7; // the count fits into a byte; lanes are summed in bytes
      std::int64_t count = 0;
      for (std::int64_t first = begin; first < end; first += few)
      {
        count += hidePoints(valid + first, std::min(few, end - first), ghosts + first);
      }
      counts[std::size_t(thread)] += count;
    });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
}

void fillCellGhosts(const unsigned char* valid, int threads, vtkImageData* image)
{
  unsigned char* const first = addGhosts(image->GetCellData(), image->GetNumberOfCells());
  int dimensions[3];
  image->GetDimensions(dimensions);
  const std::int64_t width = dimensions[0];
  const std::int64_t layer = width * dimensions[1];
  const int columns = std::max(1, dimensions[0] - 1);
  const int rows = std::max(1, dimensions[1] - 1);
  const int layers = std::max(1, dimensions[2] - 1);
  const std::int64_t right = dimensions[0] > 1 ? 1 : 0;
  const std::int64_t back = dimensions[1] > 1 ? width : 0;
  const std::int64_t up = dimensions[2] > 1 ? layer : 0;
  const auto fillRow = [&](std::int64_t row, std::vector<unsigned char>& corners)
  {
    const unsigned char* const points = valid + row / rows * layer + row % rows * width;
    joinRows({ points, points + back, points + up, points + up + back }, width, corners.data());
    hideCells(corners.data(), right, columns, first + row * columns);
  };
  forChunks(std::int64_t(rows) * layers, 64, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      std::vector<unsigned char> corners(static_cast<std::size_t>(width));
      for (std::int64_t row = begin; row < end; ++row)
      {
        fillRow(row, corners);
      }
    });
}

} // namespace

void refuseTooLarge(const Lattice& local, const Lattice& wanted, bool exchanging,
  const std::vector<vtkPointSet*>& meshes, const SamplingSettings& settings)
{
  // Bytes per sample: the claims; the mask with its two ghost arrays.
  constexpr double claims = 4;
  constexpr double mask = 3;
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
  requireMemory(std::max(count(local), count(wanted)), needed);
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
  data->AddArray(samples.mask());
  if (lattice.empty())
  {
    return 0;
  }
  const unsigned char* const valid = samples.valid();
  fillCellGhosts(valid, threads, image);
  return fillPointGhosts(valid, samples.samples(), threads, addGhosts(data, samples.samples()));
}

void fillTable(const SamplingReport& report, vtkTable* table)
{
  const SamplingStatistics& statistics = report.Statistics;
  RunStatistics run;
  run.add("", "Cells", statistics.Cells);
  run.add("", "IgnoredCells", statistics.Ignored);
  run.add("", "VisitedCells", statistics.Claims.VisitedCells);
  run.add("", "Tests", statistics.Claims.Tests);
  run.add("", "ExactTests", statistics.Claims.ExactTests);
  run.add("", "OverlappingClaims", statistics.Claims.OverlappingClaims);
  run.add("", "Samples", report.Samples);
  run.add("", "SamplesHit", report.Hits);
  run.add("", "Threads", report.Threads);
  run.Totals.push_back({ "", "Device", std::vector<std::string>{ statistics.Device } });
  run.Lists.push_back({ "phases", false,
    { { "", "PhaseName",
        std::vector<std::string>{
          "preparation", "claims", "interpolation", "transfer", "exchange", "output" } },
      { "", "PhaseSeconds",
        std::vector<double>{ statistics.PreparationSeconds, statistics.ClaimSeconds,
          statistics.InterpolationSeconds, statistics.TransferSeconds, report.ExchangeSeconds,
          report.OutputSeconds } } } });
  table->Initialize();
  fillStatisticsTable(run, table);
}

} // namespace tipp
