// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/ReadPiece.h"

#include "Arrays/Scalar.h"
#include "Partitioned/PieceFormat.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <cstring>

namespace tipp
{
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
  name.empty() ? void() : array->SetName(name.c_str());
  return array;
}

vtkSmartPointer<vtkDataArray> newArray(Scalar type)
{
  return vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeOf(type)));
}

void setIds(
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
vtkSmartPointer<vtkCellArray> makeCells(Piece& piece)
{
  const vtkIdType corners = piece.CellSize;
  vtkNew<Array> offsets;
  offsets->SetNumberOfValues(piece.Cells + 1);
  for (vtkIdType i = 0; i <= piece.Cells; ++i)
  {
    offsets->SetValue(i, typename Array::ValueType(i * corners));
  }
  const auto connectivity = takeOver(
    std::move(piece.Connectivity), vtkSmartPointer<Array>::New(), 1, piece.Cells * corners);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets.Get(), connectivity.Get());
  return cells;
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
  setIds(std::move(piece.PointIds), piece.Points, pointIdsName, grid->GetPointData());
  addGhosts(std::move(piece.PointGhosts), piece.Points, grid->GetPointData());
  grid->SetCells(piece.CellSize == 3 ? VTK_TRIANGLE : VTK_TETRA,
    piece.WideIds ? makeCells<vtkTypeInt64Array>(piece) : makeCells<vtkTypeInt32Array>(piece));
  setIds(std::move(piece.CellIds), piece.Cells, cellIdsName, grid->GetCellData());
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

} // namespace tipp
