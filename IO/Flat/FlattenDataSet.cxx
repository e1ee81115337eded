// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlattenDataSet.h"

#include "Arrays/Scalar.h"
#include "Files/IOError.h"
#include "Files/VtkXml.h"
#include "Parallel/Poll.h"
#include "Predicates/Geometry.h"
#include "Vtk/CellArrays.h"
#include "Vtk/DataSets.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cstring>

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

/// Cuts a data set's cells into triangles or tetrahedra over its own points.
class Cutter
{
public:
  Cutter(vtkDataSet* data, const std::string& path, Flattened& result)
    : Data(data)
    , Path(path)
    , Ghosts(data->GetCellGhostArray())
    , Result(result)
    , Cells(result.Content.Cells)
  {
  }

  /// Sets the result's cells, and which cells were cut or left out. Returns the id of each
  /// simplex's cell in the data set; empty if it equals the simplex's index.
  Ids cut()
  {
    const int dimension = this->findDimension();
    this->CellSize = std::size_t(dimension) + 1;
    this->Result.Content.CellSize = dimension + 1;
    const vtkIdType cells = this->Data->GetNumberOfCells();
    this->Cells.reserve(std::size_t(cells) * this->CellSize);
    this->Parents.reserve(std::size_t(cells));
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      pollAt(cell);
      const int type = this->Data->GetCellType(cell);
      if (this->isGhost(cell))
      {
        ++this->Result.GhostCells;
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
    const bool changed = this->Result.areCellsChanged();
    return changed ? std::move(this->Parents) : Ids();
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
    const std::size_t before = this->Cells.size();
    if (type == VTK_TRIANGLE || type == VTK_TETRA)
    {
      this->Data->GetCellPoints(cell, this->CellIds);
      this->Cells.insert(this->Cells.end(), this->CellIds->begin(), this->CellIds->end());
    }
    else
    {
      this->Data->GetCell(cell, this->Cell);
      this->cutOther(type);
      ++this->Result.Cut[cellTypeName(type)];
    }
    const std::size_t made = (this->Cells.size() - before) / this->CellSize;
    this->Parents.insert(this->Parents.end(), made, cell);
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
    if (this->CellSize == 4 && !quadratic)
    {
      this->cutVolume();
      return;
    }
    this->Cell->Triangulate(0, this->CellIds, this->CellPoints);
    const auto size = std::ptrdiff_t(this->CellSize);
    for (auto id = this->CellIds->begin(); this->CellIds->end() - id >= size; id += size)
    {
      this->append({ id, id + size });
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
    this->Cells.insert(this->Cells.end(), simplex.begin(), simplex.end());
  }

  double volume(const Ids& tetrahedron) const
  {
    Point3 p[4];
    for (std::size_t i = 0; i < 4; ++i)
    {
      this->Data->GetPoint(tetrahedron[i], &p[i].x);
    }
    const Point3 u = p[1] - p[0];
    const Point3 v = p[2] - p[0];
    const Point3 w = p[3] - p[0];
    return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) +
      u.z * (v.x * w.y - v.y * w.x);
  }

  vtkDataSet* Data;
  const std::string& Path;
  vtkUnsignedCharArray* Ghosts;
  vtkNew<vtkGenericCell> Cell;
  vtkNew<vtkIdList> CellIds;
  vtkNew<vtkPoints> CellPoints;
  Flattened& Result;
  Ids& Cells;
  std::size_t CellSize = 3;
  Ids Parents;
};

/// The array itself if its values are contiguous, else a contiguous copy; single bits become bytes.
vtkSmartPointer<vtkDataArray> plain(vtkDataArray* array)
{
  if (array->GetDataType() != VTK_BIT)
  {
    return contiguous(array);
  }
  const auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->DeepCopy(array);
  bytes->SetName(array->GetName());
  return bytes;
}

FlatArray flatArray(vtkDataArray* from)
{
  // Copies of the FlatArray share one reference to the VTK array.
  const auto kept = std::make_shared<vtkSmartPointer<vtkDataArray>>(plain(from));
  vtkDataArray* const array = *kept;
  FlatArray flat;
  flat.Name = array->GetName() ? array->GetName() : "";
  flat.Type = *scalarOf(array->GetDataType());
  flat.Components = array->GetNumberOfComponents();
  flat.Tuples = array->GetNumberOfTuples();
  flat.Values = array->GetVoidPointer(0);
  flat.Owner = kept;
  return flat;
}

FlatArray coordinatesOf(vtkDataSet* data)
{
  auto* const set = vtkPointSet::SafeDownCast(data);
  if (set && set->GetPoints())
  {
    const int type = set->GetPoints()->GetDataType();
    if (type == VTK_FLOAT || type == VTK_DOUBLE)
    {
      return flatArray(set->GetPoints()->GetData());
    }
  }
  vtkNew<vtkDoubleArray> points;
  points->SetNumberOfComponents(3);
  points->SetNumberOfTuples(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    pollAt(i);
    data->GetPoint(i, points->GetPointer(3 * i));
  }
  return flatArray(points);
}

std::vector<FlatArray> arraysOf(vtkDataSetAttributes* attributes, std::vector<std::string>& leftOut)
{
  std::vector<FlatArray> arrays;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = attributes->GetArray(i);
    const char* const name = attributes->GetAbstractArray(i)->GetName();
    if (name && std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0)
    {
      continue; // the ghost cells have been removed
    }
    if (!array || array->GetNumberOfComponents() < 1)
    {
      leftOut.emplace_back(name ? name : "");
      continue;
    }
    arrays.push_back(flatArray(array));
    if (arrays.back().Name.empty())
    {
      arrays.back().Name = "array_" + std::to_string(i);
    }
  }
  return arrays;
}

} // namespace

Flattened flattenDataSet(vtkDataSet* data, const std::string& path)
{
  checkDataSet(data, path);
  Flattened flattened;
  FlatContent& content = flattened.Content;
  Ids parents = Cutter(data, path, flattened).cut();
  content.Points = coordinatesOf(data);
  content.PointData = arraysOf(data->GetPointData(), flattened.ArraysLeftOut);
  setCellData(
    flattened, arraysOf(data->GetCellData(), flattened.ArraysLeftOut), std::move(parents));
  return flattened;
}

} // namespace tipp
