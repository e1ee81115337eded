// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/ResampleOutput.h"

#include "Commands/Report.h"

#include "Arrays/Scalar.h"
#include "Dem/MakeDem.h"
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Npy/NpyFile.h"
#include "Vtk/WriteXmlFile.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkXMLImageDataWriter.h"

#include <limits>

namespace tipp
{

namespace
{

RasterGrid gridOf(const std::string& path, vtkImageData* image)
{
  int dimensions[3];
  double origin[3];
  double spacing[3];
  image->GetDimensions(dimensions);
  image->GetOrigin(origin);
  image->GetSpacing(spacing);
  if (dimensions[2] != 1)
  {
    throw IOError(path, "cannot hold several layers; give one sample along z, or use .vti.");
  }
  RasterGrid grid;
  grid.Columns = dimensions[0];
  grid.Rows = dimensions[1];
  grid.Pixel = { spacing[0], spacing[1] };
  grid.West = origin[0] - 0.5 * spacing[0];
  grid.South = origin[1] - 0.5 * spacing[1];
  return grid;
}

/// Returns the arrays with one component, NaN at samples that no cell contains.
SampledBands bandsOf(vtkImageData* image, std::vector<std::string>& names)
{
  vtkPointData* const data = image->GetPointData();
  vtkDataArray* const valid = data->GetArray("vtkValidPointMask");
  SampledBands bands;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = data->GetArray(i);
    if (!array || array == valid || array->GetNumberOfComponents() != 1 || !array->GetName() ||
      array->GetName() == std::string(vtkDataSetAttributes::GhostArrayName()))
    {
      continue;
    }
    names.emplace_back(array->GetName());
    std::vector<double> values(std::size_t(array->GetNumberOfTuples()));
    for (std::size_t j = 0; j < values.size(); ++j)
    {
      values[j] = valid->GetTuple1(vtkIdType(j)) == 1 ? array->GetTuple1(vtkIdType(j))
                                                      : std::numeric_limits<double>::quiet_NaN();
    }
    bands.Values.push_back(std::move(values));
  }
  return bands;
}

} // namespace

void writeImage(const std::string& path, vtkImageData* image, const PathState& before)
{
  PendingFile pending(path, before);
  writeXmlFile<vtkXMLImageDataWriter>(path, pending, image);
  pending.commit();
}

void writeNpy(
  const std::string& path, const std::string& name, vtkImageData* image, const PathState& before)
{
  vtkDataArray* const array = image->GetPointData()->GetArray(name.c_str());
  if (!array)
  {
    throw IOError(path, "was not written: the mesh has no array '" + name + "' in this range.");
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  std::vector<std::int64_t> shape;
  if (dimensions[2] > 1)
  {
    shape.push_back(dimensions[2]);
  }
  shape.push_back(dimensions[1]);
  shape.push_back(dimensions[0]);
  if (array->GetNumberOfComponents() > 1)
  {
    shape.push_back(array->GetNumberOfComponents());
  }
  NpyWriter writer(path, scalarDescr(*scalarOf(array->GetDataType())), shape, before);
  writer.write(array->GetVoidPointer(0),
    std::size_t(array->GetNumberOfValues()) * std::size_t(array->GetDataTypeSize()));
  writer.close();
}

void writeGeoTiff(const std::string& path, vtkImageData* image, const std::string& crs,
  double noData, int threads, const PathState& before)
{
  RasterDescription description;
  description.Grid = gridOf(path, image);
  const SampledBands bands = bandsOf(image, description.Bands);
  if (bands.Values.empty())
  {
    throw IOError(path, "would have no band, because the mesh has no array with one component.");
  }
  description.Crs = crs;
  description.NoData = noData;
  description.Threads = threads;
  const auto writer = createRaster(path, description, before);
  writeTiles(*writer, description.Grid, readFrom(description.Grid, bands), {}, threads);
  writer->close();
  warnOfHidden(writer->hidden(), noData);
}

} // namespace tipp
