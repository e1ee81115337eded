// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/Simplices.h"

#include "Files/IOError.h"
#include "Parallel/Poll.h"
#include "Vtk/CellTypeName.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>

namespace tipp
{
namespace
{

using Ids = std::vector<std::int64_t>;

int dimensionOf(int type, vtkGenericCell* cell)
{
  if (type == VTK_TRIANGLE || type == VTK_TETRA)
  {
    return type == VTK_TRIANGLE ? 2 : 3;
  }
  cell->SetCellType(type);
  return type == VTK_EMPTY_CELL ? -1 : cell->GetCellDimension();
}

/// The point ids of the face's boundary, in order around it.
Ids cornersOf(vtkCell* face)
{
  Ids corners(face->GetPointIds()->begin(), face->GetPointIds()->end());
  if (face->GetCellType() == VTK_PIXEL)
  {
    std::swap(corners[2], corners[3]);
  }
  return corners;
}

class Cutter
{
public:
  Cutter(vtkDataSet* data, const std::string& path)
    : Data(data)
    , Path(path)
    , Ghosts(data->GetCellGhostArray())
  {
  }

  Simplices cut()
  {
    const int dimension = this->findDimension();
    this->Result.CellSize = dimension + 1;
    const vtkIdType cells = this->Data->GetNumberOfCells();
    this->Result.Ids.reserve(std::size_t(cells) * std::size_t(dimension + 1));
    this->Result.Parents.reserve(std::size_t(cells));
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      pollAt(cell);
      const int type = this->Data->GetCellType(cell);
      if (this->isGhost(cell))
      {
        ++this->Result.LeftOut["ghost cell"];
      }
      else if (dimensionOf(type, this->Cell) != dimension)
      {
        ++this->Result.LeftOut[cellTypeName(type)];
      }
      else
      {
        this->cutCell(cell, type);
      }
    }
    if (this->Result.Cut.empty() && this->Result.LeftOut.empty())
    {
      this->Result.Parents = {};
    }
    return std::move(this->Result);
  }

private:
  int findDimension()
  {
    // vtkUnstructuredGrid::GetCellTypes() warns in VTK 9.2, and its successor is not in 9.1.
    std::array<bool, 256> present{};
    for (vtkIdType i = 0; i < this->Data->GetNumberOfCells(); ++i)
    {
      present[std::size_t(this->Data->GetCellType(i))] = true;
    }
    int dimension = -1;
    for (std::size_t type = 0; type < present.size(); ++type)
    {
      dimension =
        present[type] ? std::max(dimension, dimensionOf(int(type), this->Cell)) : dimension;
    }
    if (dimension < 2)
    {
      throw IOError(
        this->Path, "holds no cells with an area or a volume; triangulate its points first.");
    }
    return dimension;
  }

  bool isGhost(vtkIdType cell) const
  {
    constexpr int ghost = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    return this->Ghosts && (this->Ghosts->GetValue(cell) & ghost) != 0;
  }

  void cutCell(vtkIdType cell, int type)
  {
    const std::size_t before = this->Result.Ids.size();
    if (type == VTK_TRIANGLE || type == VTK_TETRA)
    {
      this->Data->GetCellPoints(cell, this->CellIds);
      this->Result.Ids.insert(this->Result.Ids.end(), this->CellIds->begin(), this->CellIds->end());
    }
    else
    {
      this->Data->GetCell(cell, this->Cell);
      this->cutOther(type);
      ++this->Result.Cut[cellTypeName(type)];
    }
    const std::size_t made =
      (this->Result.Ids.size() - before) / std::size_t(this->Result.CellSize);
    this->Result.Parents.insert(this->Result.Parents.end(), made, cell);
  }

  void cutOther(int type)
  {
    const bool quadratic = type == VTK_QUADRATIC_TRIANGLE || type == VTK_QUADRATIC_TETRA;
    if (!quadratic && !this->Cell->IsLinear())
    {
      throw IOError(this->Path,
        "holds a curved cell (" + cellTypeName(type) +
          ") that cannot be cut along its own points; make it linear first.");
    }
    if (this->Result.CellSize == 4 && !quadratic)
    {
      this->cutVolume();
      return;
    }
    this->Cell->Triangulate(0, this->CellIds, this->CellPoints);
    const auto size = std::size_t(this->Result.CellSize);
    const Ids ids(this->CellIds->begin(), this->CellIds->end());
    for (std::size_t i = 0; i + size <= ids.size(); i += size)
    {
      this->append({ ids.begin() + std::ptrdiff_t(i), ids.begin() + std::ptrdiff_t(i + size) });
    }
  }

  void cutVolume()
  {
    const std::int64_t apex =
      *std::min_element(this->Cell->GetPointIds()->begin(), this->Cell->GetPointIds()->end());
    for (int i = 0; i < this->Cell->GetNumberOfFaces(); ++i)
    {
      Ids face = cornersOf(this->Cell->GetFace(i));
      if (std::find(face.begin(), face.end(), apex) != face.end())
      {
        continue;
      }
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      for (std::size_t corner = 2; corner < face.size(); ++corner)
      {
        this->append({ face[0], face[corner - 1], face[corner], apex });
      }
    }
  }

  void append(Ids simplex)
  {
    if (simplex.size() == 4 && this->volume(simplex) < 0)
    {
      std::swap(simplex[0], simplex[1]);
    }
    this->Result.Ids.insert(this->Result.Ids.end(), simplex.begin(), simplex.end());
  }

  double volume(const Ids& tetrahedron) const
  {
    std::array<std::array<double, 3>, 4> p{};
    for (std::size_t i = 0; i < 4; ++i)
    {
      this->Data->GetPoint(tetrahedron[i], p[i].data());
    }
    const auto edge = [&p](std::size_t to, std::size_t axis) { return p[to][axis] - p[0][axis]; };
    return edge(1, 0) * (edge(2, 1) * edge(3, 2) - edge(2, 2) * edge(3, 1)) -
      edge(1, 1) * (edge(2, 0) * edge(3, 2) - edge(2, 2) * edge(3, 0)) +
      edge(1, 2) * (edge(2, 0) * edge(3, 1) - edge(2, 1) * edge(3, 0));
  }

  vtkDataSet* Data;
  const std::string& Path;
  vtkUnsignedCharArray* Ghosts;
  vtkNew<vtkGenericCell> Cell;
  vtkNew<vtkIdList> CellIds;
  vtkNew<vtkPoints> CellPoints;
  Simplices Result;
};

} // namespace

Simplices simplicesOf(vtkDataSet* data, const std::string& path)
{
  return Cutter(data, path).cut();
}

} // namespace tipp
