// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshFiles.h"

#include "Arrays/Scalar.h"
#include "Files/IOError.h"
#include "Partitioned/PieceFormat.h"
#include "Partitioned/ReadPiece.h"
#include "Points/ReadPoints.h"
#include "Vtk/CellArrays.h"
#include "Vtk/DataSets.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

/// Returns an array in the caller's memory. The data set is only read, so the const_cast is safe.
/// std::int64_t and VTK's 64-bit integer differ only in name (long and long long).
template <typename Array, typename Value>
vtkSmartPointer<Array> borrow(const Value* values, std::size_t count)
{
  auto array = vtkSmartPointer<Array>::New();
  using Same = typename Array::ValueType;
  static_assert(sizeof(Same) == sizeof(Value));
  array->SetArray(reinterpret_cast<Same*>(const_cast<Value*>(values)), vtkIdType(count), 1);
  return array;
}

void setPoints(const NodesView& nodes, vtkPointSet* data)
{
  const std::size_t count = nodes.size();
  const NodeColumn* const z = findZ(nodes);
  vtkNew<vtkDoubleArray> xyz;
  xyz->SetNumberOfComponents(3);
  xyz->SetNumberOfTuples(vtkIdType(count));
  double* const to = xyz->GetPointer(0);
  for (std::size_t i = 0; i < count; ++i)
  {
    to[3 * i] = nodes[i].x;
    to[3 * i + 1] = nodes[i].y;
    to[3 * i + 2] = z ? z->Values[i] : 0;
  }
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  data->SetPoints(points);
  for (const NodeColumn& column : nodes.columns())
  {
    if (&column != z)
    {
      const auto array = borrow<vtkDoubleArray>(column.Values, count);
      array->SetName(column.Name.c_str());
      data->GetPointData()->AddArray(array);
    }
  }
}

template <typename Array>
vtkSmartPointer<vtkCellArray> makeCells(vtkSmartPointer<Array> ids, std::size_t corners)
{
  using Id = typename Array::ValueType;
  const std::size_t count = std::size_t(ids->GetNumberOfValues()) / corners;
  vtkNew<Array> offsets;
  offsets->SetNumberOfValues(vtkIdType(count) + 1);
  for (std::size_t i = 0; i <= count; ++i)
  {
    offsets->SetValue(vtkIdType(i), Id(corners) * Id(i));
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets.Get(), ids.Get());
  return cells;
}

/// Cells in the memory of the ids, except for 32-bit ids that are too many for 32-bit offsets.
template <typename Id>
vtkSmartPointer<vtkCellArray> makeCells(const Id* ids, std::size_t count, std::size_t corners)
{
  const std::size_t size = count * corners;
  if constexpr (sizeof(Id) == sizeof(std::int32_t))
  {
    if (size <= std::size_t(std::numeric_limits<Id>::max()))
    {
      return makeCells(borrow<vtkTypeInt32Array>(ids, size), corners);
    }
    const auto wide = vtkSmartPointer<vtkTypeInt64Array>::New();
    wide->SetNumberOfValues(vtkIdType(size));
    std::copy(ids, ids + size, wide->GetPointer(0));
    return makeCells(wide, corners);
  }
  else
  {
    return makeCells(borrow<vtkTypeInt64Array>(ids, size), corners);
  }
}

vtkSmartPointer<vtkCellArray> makeCells(TrianglesView triangles)
{
  return triangles.withIds([&](const auto* ids) { return makeCells(ids, triangles.size(), 3); });
}

} // namespace

vtkSmartPointer<vtkPolyData> makePolyData(const PointTable& points, TrianglesView triangles)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  setPoints(points, data);
  data->SetPolys(makeCells(triangles));
  return data;
}

namespace
{

/// Makes the array take ownership of the buffer.
template <typename Array>
vtkSmartPointer<Array> takeOver(Buffer<char>&& buffer, const vtkSmartPointer<Array>& array,
  int components, std::int64_t tuples, const std::string& name = {})
{
  array->SetNumberOfComponents(components);
  array->SetVoidArray(
    buffer.release(), vtkIdType(tuples) * components, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  if (!name.empty())
  {
    array->SetName(name.c_str());
  }
  return array;
}

vtkSmartPointer<vtkDataArray> newArray(Scalar type)
{
  return vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeOf(type)));
}

void setGlobalIds(
  Buffer<char>&& buffer, std::int64_t tuples, const char* name, vtkDataSetAttributes* data)
{
  static_assert(sizeof(vtkIdType) == 8);
  data->SetGlobalIds(
    takeOver(std::move(buffer), vtkSmartPointer<vtkIdTypeArray>::New(), 1, tuples, name));
}

void addGhosts(Buffer<char>&& buffer, std::int64_t tuples, vtkDataSetAttributes* data)
{
  data->AddArray(takeOver(std::move(buffer), vtkSmartPointer<vtkUnsignedCharArray>::New(), 1,
    tuples, vtkDataSetAttributes::GhostArrayName()));
}

template <typename Array>
vtkSmartPointer<vtkCellArray> cellsOf(Piece& piece)
{
  return makeCells(takeOver(std::move(piece.Connectivity), vtkSmartPointer<Array>::New(), 1,
                     piece.Cells * piece.CellSize),
    std::size_t(piece.CellSize));
}

void addCellGhosts(const Piece& piece, vtkDataSetAttributes* data)
{
  if (piece.Cells == piece.OwnedCells)
  {
    return;
  }
  Buffer<char> ghosts{ std::size_t(piece.Cells) };
  std::memset(ghosts.data(), 0, std::size_t(piece.OwnedCells));
  std::memset(ghosts.data() + piece.OwnedCells, vtkDataSetAttributes::DUPLICATECELL,
    std::size_t(piece.Cells - piece.OwnedCells));
  addGhosts(std::move(ghosts), piece.Cells, data);
}

} // namespace

vtkSmartPointer<vtkUnstructuredGrid> makeGrid(Piece&& piece)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetData(
    takeOver(std::move(piece.Coordinates), newArray(piece.PointType), 3, piece.Points));
  grid->SetPoints(points);
  setGlobalIds(std::move(piece.PointIds), piece.Points, pointIdsName, grid->GetPointData());
  addGhosts(std::move(piece.PointGhosts), piece.Points, grid->GetPointData());
  grid->SetCells(piece.CellSize == 3 ? VTK_TRIANGLE : VTK_TETRA,
    piece.WideIds ? cellsOf<vtkTypeInt64Array>(piece) : cellsOf<vtkTypeInt32Array>(piece));
  setGlobalIds(std::move(piece.CellIds), piece.Cells, cellIdsName, grid->GetCellData());
  addCellGhosts(piece, grid->GetCellData());
  for (Piece::Attribute& attribute : piece.Attributes)
  {
    const StoredArray& description = attribute.Description;
    vtkFieldData* const data = description.OfPoints
      ? static_cast<vtkFieldData*>(grid->GetPointData())
      : static_cast<vtkFieldData*>(grid->GetCellData());
    data->AddArray(takeOver(std::move(attribute.Values), newArray(description.Type),
      description.Components, description.OfPoints ? piece.Points : piece.Cells, description.Name));
  }
  return grid;
}

namespace
{

/// The point ids of a data set's cells, which must all be triangles or all tetrahedra.
std::vector<std::int64_t> cellIdsOf(vtkDataSet* data, int type, const std::string& path)
{
  const bool areTriangles = type == VTK_TRIANGLE;
  std::vector<std::int64_t> all;
  all.reserve((areTriangles ? 3 : 4) * std::size_t(data->GetNumberOfCells()));
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (data->GetCellType(cell) != type)
    {
      throw IOError(path,
        std::string("holds a cell that is not a ") + (areTriangles ? "triangle" : "tetrahedron") +
          " (cell " + std::to_string(cell) +
          (areTriangles ? "); triangulate its cells first." : ")."));
    }
    data->GetCellPoints(cell, ids);
    all.insert(all.end(), ids->begin(), ids->end());
  }
  return all;
}

/// The type of the first cell; VTK_EMPTY_CELL without cells.
int firstTypeOf(vtkDataSet* data)
{
  return data->GetNumberOfCells() > 0 ? data->GetCellType(0) : VTK_EMPTY_CELL;
}

/// The data set's array NeighborIds; empty unless it has one component per corner of a cell.
std::vector<std::int64_t> neighborsOf(vtkDataSet* data, int corners)
{
  vtkDataArray* const array = data->GetCellData()->GetArray(neighborIdsName);
  if (!array || array->GetNumberOfComponents() != corners)
  {
    return {};
  }
  const PlainIds plain = PlainIds(array).widened();
  const auto* const ids = static_cast<const std::int64_t*>(plain.data());
  return { ids, ids + plain.count() };
}

} // namespace

TriangleMesh readVtkTriangles(const std::string& path)
{
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  std::vector<std::int64_t> ids = cellIdsOf(data, VTK_TRIANGLE, path);
  return { std::move(ids), std::move(pointsOf(data).XY), neighborsOf(data, 3) };
}

bool holdsVtkTriangles(const std::string& path)
{
  return firstTypeOf(readDataSet(path)) == VTK_TRIANGLE;
}

bool holdsVtkTetrahedra(const std::string& path)
{
  return firstTypeOf(readDataSet(path)) == VTK_TETRA;
}

StoredTetrahedra readVtkTetrahedra(const std::string& path)
{
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  StoredTetrahedra mesh;
  mesh.Ids = cellIdsOf(data, VTK_TETRA, path);
  mesh.XYZ.resize(3 * std::size_t(data->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    data->GetPoint(i, &mesh.XYZ[3 * std::size_t(i)]);
  }
  mesh.Neighbors = neighborsOf(data, 4);
  return mesh;
}

} // namespace tipp
