// SPDX-License-Identifier: BSD-3-Clause
#include "Output/TetrahedronOutput.h"

#include "Output/PiecePoints.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkUnstructuredGrid.h"

#include <limits>
#include <stdexcept>

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
  output->SetCells(size == 3 ? VTK_TRIANGLE : VTK_TETRA,
    takeCells(cornersOf<std::int32_t>(piece, mine, size, own, ghosts), int(size)));
  setCellIds(0, 0, mine, own, ghosts, output);
  if (ghosts)
  {
    addCellGhosts(own, ghosts->Cells.size(), output);
  }
}

} // namespace tipp
