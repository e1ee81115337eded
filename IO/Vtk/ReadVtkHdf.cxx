// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/ReadVtkHdf.h"

#include "Files/IOError.h"
#include "Hdf/VtkHdfFile.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tipp
{
namespace
{

vtkSmartPointer<vtkDataArray> arrayOf(const HdfValues& values)
{
  auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeOf(values.Type)));
  array->SetNumberOfComponents(int(values.Components));
  array->SetNumberOfTuples(values.Tuples);
  std::copy(values.Bytes.begin(), values.Bytes.end(), static_cast<char*>(array->GetVoidPointer(0)));
  return array;
}

vtkSmartPointer<vtkIdTypeArray> idsOf(const std::vector<std::int64_t>& values)
{
  auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
  ids->SetNumberOfTuples(vtkIdType(values.size()));
  std::copy(values.begin(), values.end(), ids->GetPointer(0));
  return ids;
}

vtkSmartPointer<vtkCellArray> cellsOf(const HdfCells& cells)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  array->SetData(idsOf(cells.Offsets), idsOf(cells.Ids));
  return array;
}

vtkSmartPointer<vtkPointSet> readGrid(VtkHdfFile& file)
{
  const HdfCells cells = file.readCells(0);
  if (std::find(cells.Types.begin(), cells.Types.end(), VTK_POLYHEDRON) != cells.Types.end())
  {
    throw IOError(file.path(), "has polyhedra, which are not read from VTKHDF; cut them first.");
  }
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfTuples(vtkIdType(cells.Types.size()));
  std::copy(cells.Types.begin(), cells.Types.end(), types->GetPointer(0));
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetCells(types, cellsOf(cells));
  return grid;
}

vtkSmartPointer<vtkPointSet> readPolyData(VtkHdfFile& file)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetVerts(cellsOf(file.readCells(0, "Vertices")));
  data->SetLines(cellsOf(file.readCells(0, "Lines")));
  data->SetPolys(cellsOf(file.readCells(0, "Polygons")));
  data->SetStrips(cellsOf(file.readCells(0, "Strips")));
  return data;
}

} // namespace

vtkSmartPointer<vtkDataSet> readVtkHdf(const std::string& path)
{
  VtkHdfFile file(path);
  if (file.steps() > 1)
  {
    throw IOError(path,
      "has " + std::to_string(file.steps()) +
        " time steps, and one is needed here; extract it in ParaView, or flatten the file with "
        "'tipp flatten'.");
  }
  const vtkSmartPointer<vtkPointSet> data = file.isPolyData() ? readPolyData(file) : readGrid(file);
  vtkNew<vtkPoints> points;
  points->SetData(arrayOf(file.readPoints(0)));
  data->SetPoints(points);
  for (const HdfArray& array : file.arrays())
  {
    const vtkSmartPointer<vtkDataArray> values = arrayOf(file.read(array, 0));
    values->SetName(array.Name.c_str());
    array.OnCells ? data->GetCellData()->AddArray(values) : data->GetPointData()->AddArray(values);
  }
  return data;
}

} // namespace tipp
