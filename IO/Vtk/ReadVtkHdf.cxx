// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/ReadVtkHdf.h"

#include "Files/IOError.h"
#include "Hdf/VtkHdfFile.h"
#include "Partitioned/VirtualHdf.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
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
  for (const unsigned char type : cells.Types)
  {
    requireCellType(file.path(), type);
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

/// Throws IOError unless all steps have the same points and cells.
void requireOneMesh(VtkHdfFile& file)
{
  for (std::size_t step = 1; step < file.steps(); ++step)
  {
    if (!file.haveEqualMesh(step, 0))
    {
      throw IOError(file.path(),
        "has other points or cells at step " + std::to_string(step) +
          " (from 0) than at step 0, and one mesh is needed here; extract a step in ParaView.");
    }
  }
}

} // namespace

vtkSmartPointer<vtkDataSet> readVtkHdf(const std::string& path)
{
  requirePiecesOf(path);
  VtkHdfFile file(path);
  requireOneMesh(file);
  const vtkSmartPointer<vtkPointSet> data = file.isPolyData() ? readPolyData(file) : readGrid(file);
  vtkNew<vtkPoints> points;
  points->SetData(arrayOf(file.readPoints(0)));
  data->SetPoints(points);
  for (const HdfArray& array : file.arrays())
  {
    const bool isSplit = array.Name != vtkDataSetAttributes::GhostArrayName() && file.varies(array);
    for (std::size_t step = 0; step < (isSplit ? file.steps() : 1); ++step)
    {
      const vtkSmartPointer<vtkDataArray> values = arrayOf(file.read(array, step));
      const std::string suffix = isSplit ? " step " + std::to_string(step) : "";
      values->SetName((array.Name + suffix).c_str());
      array.OnCells ? data->GetCellData()->AddArray(values)
                    : data->GetPointData()->AddArray(values);
    }
  }
  return data;
}

} // namespace tipp
