// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPPointsToImage.h"

#include "Dem/MakeDem.h"
#include "Parallel/ParallelFor.h"
#include "Pipeline/FilterPipeline.h"
#include "Pipeline/InputPoints.h"
#include "Points/ReadPoints.h"
#include "Sampling/SamplingRange.h"
#include "Triangulation/PointsView.h"
#include "Vtk/DataSets.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

vtkStandardNewMacro(vtkTIPPPointsToImage);

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{

vtkSmartPointer<vtkDoubleArray> arrayOf(const std::string& name, const std::vector<double>& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfValues(vtkIdType(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

void setGrid(const tipp::RasterGrid& grid, vtkImageData* image)
{
  const tipp::Point2 first = grid.firstCentre();
  image->SetOrigin(first.x, first.y, 0);
  image->SetSpacing(grid.Pixel[0], grid.Pixel[1], 1);
  image->SetDimensions(int(grid.Columns), int(grid.Rows), 1);
}

} // namespace

vtkTIPPPointsToImage::vtkTIPPPointsToImage()
{
  this->SetNumberOfInputPorts(3);
}

int vtkTIPPPointsToImage::FillInputPortInformation(int port, vtkInformation* info)
{
  return tipp::acceptInput(info, port == 0 ? "vtkPointSet" : "vtkPolyData", port > 0);
}

/// `points` may be null if Resolution and SamplingBounds are used.
tipp::RasterGrid vtkTIPPPointsToImage::Grid(vtkPointSet* points) const
{
  tipp::RasterRequest request;
  request.Resolution = this->Resolution;
  request.Aligned = this->AlignToResolution;
  const tipp::Box2 bounds = this->UseInputBounds ? this->PointBounds(points)
                                                 : tipp::boxOfVtkBounds<2>(this->SamplingBounds);
  if (points && request.Resolution == 0)
  {
    const double area = bounds.width(0) * bounds.width(1);
    const double count = double(std::max<vtkIdType>(points->GetNumberOfPoints(), 1));
    request.Resolution = area > 0 ? std::sqrt(area / count) : 1;
  }
  return tipp::makeRasterGrid(request, bounds);
}

int vtkTIPPPointsToImage::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const outInfo = outputs->GetInformationObject(0);
  return tipp::runReported(this, nullptr, "", nullptr,
    [&]
    {
      vtkPointSet* points = nullptr;
      if (this->UseInputBounds || this->Resolution == 0)
      {
        points = vtkPointSet::SafeDownCast(tipp::updatedInput(this, 0, 1, outInfo));
        if (!points)
        {
          throw std::runtime_error("The input has not been made, so its extent is not known.");
        }
      }
      vtkNew<vtkImageData> image;
      setGrid(this->Grid(points), image);
      outInfo->Set(Pipeline::WHOLE_EXTENT(), image->GetExtent(), 6);
      outInfo->Set(vtkDataObject::ORIGIN(), image->GetOrigin(), 3);
      outInfo->Set(vtkDataObject::SPACING(), image->GetSpacing(), 3);
    });
}

int vtkTIPPPointsToImage::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  return tipp::askForWholeInputs(inputs, 3);
}

/// The points with their elevation and those single-component arrays that are bands. An array named
/// elevation replaces the points' z.
tipp::PointTable vtkTIPPPointsToImage::Table(vtkPointSet* points) const
{
  vtkNew<vtkPolyData> chosen;
  chosen->SetPoints(points->GetPoints());
  for (const std::string& name : tipp::columnsForBands(this->Bands))
  {
    vtkDataArray* const array = points->GetPointData()->GetArray(name.c_str());
    if (array && array->GetNumberOfComponents() == 1 && name != "z" && name != "Z")
    {
      chosen->GetPointData()->AddArray(array);
    }
  }
  tipp::PointTable table = tipp::pointsOf(chosen);
  if (chosen->GetPointData()->HasArray("elevation"))
  {
    table.Columns.erase(table.Columns.begin()); // the points' z
  }
  return table;
}

std::unique_ptr<tipp::PointStream> vtkTIPPPointsToImage::Stream(vtkPointSet* points) const
{
  tipp::Thinning thinning;
  thinning.Cell = this->ThinningSize;
  thinning.Keep = static_cast<tipp::Thinning::Rule>(this->ThinningRule);
  return tipp::streamTable(this->Table(points), thinning);
}

tipp::Box2 vtkTIPPPointsToImage::PointBounds(vtkPointSet* points) const
{
  tipp::Box2 box = tipp::Box2::empty();
  if (this->ThinningSize > 0)
  {
    constexpr std::size_t blockPoints = 1 << 16;
    tipp::forEachBlock(*this->Stream(points), blockPoints,
      [&](const tipp::PointBlock& block)
      {
        const tipp::PointsView view(block.XY.data(), block.size(), 2);
        box.extend(tipp::surveyPoints(view, 1).Bounds);
      });
  }
  else
  {
    const tipp::ProjectedPoints projected(points->GetPoints(), nullptr);
    box = tipp::surveyPoints(projected.view(), tipp::threadCount(this->NumberOfThreads)).Bounds;
  }
  if (box.isEmpty())
  {
    throw std::runtime_error("There is no point with finite coordinates.");
  }
  return box;
}

void vtkTIPPPointsToImage::Constrain(
  vtkPolyData* lines, vtkPolyData* boundary, tipp::DemRequest& request) const
{
  std::optional<tipp::ConstraintTable> lineTable;
  std::optional<tipp::ConstraintTable> boundaryTable;
  if (!this->BreaklinesFileName.empty())
  {
    lineTable = tipp::readBreaklines(this->BreaklinesFileName);
  }
  else if (lines)
  {
    lineTable = tipp::constraintsOf(lines);
    tipp::dropPlainHeights(*lineTable);
  }
  if (lineTable && this->SoftBreaklines)
  {
    lineTable->Height.clear();
  }
  if (!this->BoundaryFileName.empty())
  {
    boundaryTable = tipp::readBoundary(this->BoundaryFileName);
  }
  else if (boundary)
  {
    boundaryTable = tipp::constraintsOf(boundary);
    tipp::requireClosedBoundary(*boundaryTable);
  }
  tipp::constrain(request, std::move(lineTable), std::move(boundaryTable));
}

void vtkTIPPPointsToImage::Make(vtkInformationVector** inputs, vtkImageData* output)
{
  vtkPointSet* const points = vtkPointSet::GetData(inputs[0]);
  vtkPolyData* const lines = vtkPolyData::GetData(inputs[1]);
  vtkPolyData* const boundary = vtkPolyData::GetData(inputs[2]);
  tipp::checkPoints(points, "the input");
  for (vtkPolyData* const data : { lines, boundary })
  {
    if (data)
    {
      tipp::checkCells(data, "the lines", this->NumberOfThreads);
    }
  }
  if (this->Bands.empty())
  {
    throw std::runtime_error("There is no band: add one, as elevation.");
  }
  tipp::DemRequest request;
  request.Raster.Like = this->Grid(points);
  if (!this->UseInputBounds)
  {
    request.Raster.Bounds = tipp::boxOfVtkBounds<2>(this->SamplingBounds);
  }
  request.StrictBounds = this->StrictBounds;
  request.Bands = this->Bands;
  request.MaximumEdge = this->MaximumEdgeLength;
  request.Threads = this->NumberOfThreads;
  request.Duplicates = static_cast<tipp::DuplicateRule>(this->Duplicates);
  this->Constrain(lines, boundary, request);
  tipp::Monitor monitor(this);
  tipp::TerrainSettings settings;
  tipp::BandValues samples;
  const tipp::OutOfCoreStatistics figures = tipp::makeDem(
    this->Stream(points), request, std::uint64_t(this->MemoryLimit),
    [&](double done) { return monitor(done); }, settings, samples);
  if (figures.Aborted)
  {
    return;
  }
  if (figures.Rejected > 0)
  {
    vtkWarningMacro(<< figures.Rejected << " points with a NaN or infinite x or y are left out.");
  }
  const tipp::RasterGrid& grid = settings.Grid;
  setGrid(grid, output);
  output->GetFieldData()->AddArray(
    arrayOf("GeoTransform", { grid.West, grid.Pixel[0], 0, grid.north(), 0, -grid.Pixel[1] }));
  tipp::fillVoids(settings.Bands, samples);
  for (std::size_t band = 0; band < this->Bands.size(); ++band)
  {
    output->GetPointData()->AddArray(arrayOf(this->Bands[band], samples[band]));
    std::vector<double>().swap(samples[band]);
  }
  output->GetPointData()->SetActiveScalars(this->Bands.front().c_str());
}

int vtkTIPPPointsToImage::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* const output = vtkImageData::GetData(outputs);
  output->Initialize();
  return tipp::runReported(this, nullptr, "", outputs, [&] { this->Make(inputs, output); });
}

void vtkTIPPPointsToImage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(BreaklinesFileName);
  vtkTIPPPrintMacro(SoftBreaklines);
  vtkTIPPPrintMacro(BoundaryFileName);
  vtkTIPPPrintMacro(Resolution);
  vtkTIPPPrintMacro(UseInputBounds);
  vtkTIPPPrintMacro(SamplingBounds);
  vtkTIPPPrintMacro(StrictBounds);
  vtkTIPPPrintMacro(AlignToResolution);
  vtkTIPPPrintMacro(Bands);
  vtkTIPPPrintMacro(MaximumEdgeLength);
  vtkTIPPPrintMacro(Duplicates);
  vtkTIPPPrintMacro(ThinningSize);
  vtkTIPPPrintMacro(ThinningRule);
  vtkTIPPPrintMacro(MemoryLimit);
  vtkTIPPPrintMacro(NumberOfThreads);
}
