// SPDX-License-Identifier: BSD-3-Clause
#include "Output/TetrahedronOutput.h"

#include "Output/PiecePoints.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkUnstructuredGrid.h"

#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{

const Point3* coordinatesOf(vtkPoints* points, std::vector<Point3>& copy)
{
  static_assert(sizeof(Point3) == 3 * sizeof(double), "a point is its coordinates");
  if (auto* const doubles = vtkDoubleArray::SafeDownCast(points->GetData()))
  {
    return reinterpret_cast<const Point3*>(doubles->GetPointer(0));
  }
  copy.resize(std::size_t(points->GetNumberOfPoints()));
  for (std::size_t i = 0; i < copy.size(); ++i)
  {
    points->GetPoint(vtkIdType(i), &copy[i].x);
  }
  return copy.data();
}

void fillPiece(const DistributedTetrahedralization& mine, int rank, const PointRows& rows,
  const GhostTetrahedra* ghosts, vtkUnstructuredGrid* output)
{
  const PiecePoints<DistributedTetrahedralization, GhostTetrahedra> piece(mine, rank, ghosts);
  if (piece.count() > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("a piece has more than 2,147,483,647 points; use more ranks.");
  }
  fillPoints(piece, rows, mine.RowSize, ghosts != nullptr, output);
  const std::size_t size = mine.cellSize();
  const std::size_t own = mine.cellCount();
  const std::size_t more = ghosts ? ghosts->Cells.size() : 0;
  Buffer<std::int32_t> corners(size * (own + more));
  std::int32_t* to = corners.data();
  mine.forEachCorner(
    [&](std::int32_t index) { *to++ = std::int32_t(piece.ofLocalIndex(std::size_t(index))); });
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName("GlobalCellIds");
  numbers->SetNumberOfValues(vtkIdType(own) + vtkIdType(more));
  for (std::size_t i = 0; i < own; ++i)
  {
    numbers->SetValue(vtkIdType(i), vtkIdType(mine.FirstCell) + vtkIdType(i));
  }
  for (std::size_t i = 0; i < more; ++i)
  {
    numbers->SetValue(vtkIdType(own) + vtkIdType(i), vtkIdType(ghosts->Numbers[i]));
    for (std::size_t k = 0; k < size; ++k)
    {
      *to++ = std::int32_t(piece.ofId(ghosts->Cells[i][k]));
    }
  }
  output->SetCells(size == 3 ? VTK_TRIANGLE : VTK_TETRA, takeCells(std::move(corners), int(size)));
  output->GetCellData()->SetGlobalIds(numbers);
  if (ghosts)
  {
    addCellGhosts(own, more, output);
  }
}

} // namespace tipp
