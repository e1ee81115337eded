// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SimplexParts.h"

#include "Sampling/CellPulling.h"
#include "Vtk/CheckDataSet.h"
#include "Vtk/Compatibility.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace tipp
{
namespace
{

vtkSmartPointer<vtkDataArray> coordinatesOf(vtkPointSet* mesh)
{
  vtkSmartPointer<vtkDataArray> data = mesh->GetPoints()->GetData();
  const int type = data->GetDataType();
  if (data->HasStandardMemoryLayout() && (type == VTK_FLOAT || type == VTK_DOUBLE))
  {
    return data;
  }
  const auto copy = vtkSmartPointer<vtkDoubleArray>::New();
  copy->DeepCopy(data);
  return copy;
}

/// The mesh's cell array if all cells have the type, else null.
vtkCellArray* uniformCells(vtkPointSet* mesh, int type)
{
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(mesh))
  {
    const auto types = cellTypes(grid);
    if (!types || types->GetNumberOfValues() == 0)
    {
      return nullptr;
    }
    // Compares each byte with the next one, the fastest way for many bytes.
    const unsigned char* const begin = types->GetPointer(0);
    const std::size_t pairs = std::size_t(types->GetNumberOfValues()) - 1;
    const bool uniform = *begin == type && std::memcmp(begin, begin + 1, pairs) == 0;
    return uniform ? grid->GetCells() : nullptr;
  }
  auto* surface = vtkPolyData::SafeDownCast(mesh);
  const bool uniform = surface && type == VTK_TRIANGLE && surface->GetNumberOfPolys() > 0 &&
    surface->GetNumberOfPolys() == surface->GetNumberOfCells() &&
    surface->GetPolys()->IsHomogeneous() == 3;
  return uniform ? surface->GetPolys() : nullptr;
}

bool takeUniform(vtkPointSet* mesh, int type, SimplexSet& simplices)
{
  vtkCellArray* cells = uniformCells(mesh, type);
  const vtkIdType corners = type == VTK_TRIANGLE ? 3 : 4;
  if (!cells || cells->GetNumberOfConnectivityIds() != corners * cells->GetNumberOfCells())
  {
    return false;
  }
  simplices.Stored = PlainIds(cells->GetConnectivityArray());
  simplices.Mesh.Ids = simplices.Stored.data();
  simplices.Mesh.Wide = simplices.Stored.isWide();
  simplices.Mesh.Cells = cells->GetNumberOfCells();
  return true;
}

/// Cuts cells of any type into simplices.
class Cutter
{
public:
  Cutter(vtkPointSet* mesh, SimplexParts& parts)
    : Mesh(mesh)
    , Parts(parts)
  {
  }

  void cut(vtkIdType cell)
  {
    const int type = this->Mesh->GetCellType(cell);
    switch (type)
    {
      case VTK_TRIANGLE:
        this->append(this->Parts.Triangles, cell);
        break;
      case VTK_TETRA:
        this->append(this->Parts.Tetrahedra, cell);
        break;
      case VTK_QUAD:
      case VTK_PIXEL:
        this->loadCorners(cell);
        if (type == VTK_PIXEL)
        {
          std::swap(this->Corners[2], this->Corners[3]);
        }
        CellPulling::polygon(this->Corners, this->Parts.Triangles.Ids);
        break;
      case VTK_HEXAHEDRON:
      case VTK_VOXEL:
      case VTK_WEDGE:
      case VTK_PYRAMID:
        this->loadCorners(cell);
        CellPulling::polyhedron(
          this->Corners, CellPulling::facesOf(type), this->Parts.Tetrahedra.Ids);
        break;
      default:
        this->cutAsVtk(cell);
    }
    this->Parts.Triangles.Parents.resize(this->Parts.Triangles.Ids.size() / 3, cell);
    this->Parts.Tetrahedra.Parents.resize(this->Parts.Tetrahedra.Ids.size() / 4, cell);
  }

private:
  void loadCorners(vtkIdType cell)
  {
    this->Mesh->GetCellPoints(cell, this->Ids);
    this->Corners.clear();
    for (const vtkIdType id : *this->Ids)
    {
      double p[3];
      this->Mesh->GetPoint(id, p);
      this->Corners.push_back({ { p[0], p[1], p[2] }, id });
    }
  }

  void cutAsVtk(vtkIdType id)
  {
    this->Mesh->GetCell(id, this->Cell);
    const int dimension = this->Cell->GetCellDimension();
    if (dimension < 2)
    {
      ++this->Parts.Thin;
      return;
    }
    this->Cell->Triangulate(0, this->Ids, this->Points);
    std::vector<std::int64_t>& ids =
      (dimension == 2 ? this->Parts.Triangles : this->Parts.Tetrahedra).Ids;
    ids.insert(ids.end(), this->Ids->begin(), this->Ids->end());
  }

  /// Appends a cell that is a simplex.
  void append(SimplexSet& simplices, vtkIdType cell)
  {
    this->Mesh->GetCellPoints(cell, this->Ids);
    simplices.Ids.insert(simplices.Ids.end(), this->Ids->begin(), this->Ids->end());
  }

  vtkPointSet* Mesh;
  SimplexParts& Parts;
  std::vector<CellPulling::Corner> Corners;
  vtkNew<vtkIdList> Ids;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkGenericCell> Cell;
};

/// By cell: whether vtkGhostType hides it; empty if it hides none.
std::vector<unsigned char> hiddenCells(vtkPointSet* mesh)
{
  std::vector<unsigned char> hidden;
  vtkUnsignedCharArray* const ghosts = mesh->GetCellGhostArray();
  const vtkIdType cells = mesh->GetNumberOfCells();
  if (ghosts && ghosts->GetNumberOfValues() >= cells)
  {
    const unsigned char* const begin = ghosts->GetPointer(0);
    const auto hides = [](int ghost) { return (ghost & vtkDataSetAttributes::HIDDENCELL) != 0; };
    if (std::any_of(begin, begin + cells, hides))
    {
      hidden.resize(std::size_t(cells));
      std::transform(begin, begin + cells, hidden.begin(), hides);
    }
  }
  return hidden;
}

/// Hides the cells with a corner that is not finite, and counts those that were not hidden before.
void hideNotFinite(vtkPointSet* mesh, const std::vector<int>& axes, SimplexParts& parts,
  std::vector<unsigned char>& hidden)
{
  const std::vector<int> counting = hasVolumes(mesh) ? std::vector<int>{ 0, 1, 2 } : axes;
  std::vector<bool> finite(std::size_t(mesh->GetNumberOfPoints()), true);
  for (std::size_t id = 0; id < finite.size(); ++id)
  {
    double p[3];
    mesh->GetPoint(vtkIdType(id), p);
    finite[id] = std::all_of(
      counting.begin(), counting.end(), [&](int axis) { return std::isfinite(p[axis]); });
  }
  hidden.resize(std::size_t(mesh->GetNumberOfCells()), 0);
  vtkNew<vtkIdList> ids;
  for (std::size_t cell = 0; cell < hidden.size(); ++cell)
  {
    mesh->GetCellPoints(vtkIdType(cell), ids);
    const bool whole =
      std::all_of(ids->begin(), ids->end(), [&](vtkIdType id) { return finite[std::size_t(id)]; });
    if (!whole && hidden[cell] == 0)
    {
      hidden[cell] = 1;
      ++parts.NotFinite;
    }
  }
}

void finish(SimplexSet& simplices, int dimension, const SimplexParts& parts)
{
  SimplexMesh& mesh = simplices.Mesh;
  mesh.Dimension = dimension;
  mesh.Points = parts.Coordinates->GetVoidPointer(0);
  mesh.PointCount = parts.Coordinates->GetNumberOfTuples();
  mesh.Float = parts.Coordinates->GetDataType() == VTK_FLOAT;
  mesh.Hidden = simplices.Hidden.empty() ? nullptr : simplices.Hidden.data();
  if (!simplices.Ids.empty())
  {
    mesh.Ids = simplices.Ids.data();
    mesh.Wide = true;
    mesh.Cells = std::int64_t(simplices.Ids.size()) / (dimension + 1);
  }
}

} // namespace

bool hasVolumes(vtkPointSet* mesh)
{
  // Polygonal meshes have no three-dimensional cells.
  const vtkIdType cells = vtkPolyData::SafeDownCast(mesh) ? 0 : mesh->GetNumberOfCells();
  vtkNew<vtkGenericCell> cell;
  int known = VTK_EMPTY_CELL;
  for (vtkIdType i = 0; i < cells; ++i)
  {
    const int type = mesh->GetCellType(i);
    if (type != known)
    {
      known = type;
      cell->SetCellType(type);
      if (cell->GetCellDimension() == 3)
      {
        return true;
      }
    }
  }
  return false;
}

SimplexParts makeSimplices(vtkPointSet* mesh, const std::vector<int>& axes, int threads)
{
  SimplexParts parts;
  parts.Triangles.Mesh.Dimension = 2;
  parts.Tetrahedra.Mesh.Dimension = 3;
  const vtkIdType count = mesh->GetPoints() ? mesh->GetNumberOfCells() : 0;
  if (count == 0)
  {
    return parts;
  }
  parts.Coordinates = coordinatesOf(mesh);
  std::vector<unsigned char> hidden = hiddenCells(mesh);
  if (!allPointsFinite(mesh, threads))
  {
    hideNotFinite(mesh, axes, parts, hidden);
  }
  if (takeUniform(mesh, VTK_TRIANGLE, parts.Triangles))
  {
    parts.Triangles.Hidden = std::move(hidden);
  }
  else if (takeUniform(mesh, VTK_TETRA, parts.Tetrahedra))
  {
    parts.Tetrahedra.Hidden = std::move(hidden);
  }
  else
  {
    Cutter cutter(mesh, parts);
    for (vtkIdType cell = 0; cell < count; ++cell)
    {
      if (hidden.empty() || !hidden[std::size_t(cell)])
      {
        cutter.cut(cell);
      }
    }
  }
  finish(parts.Triangles, 2, parts);
  finish(parts.Tetrahedra, 3, parts);
  return parts;
}

void hideMarked(SimplexSet& simplices, const std::vector<bool>& markedPoints)
{
  SimplexMesh& mesh = simplices.Mesh;
  simplices.Hidden.resize(std::size_t(mesh.Cells), 0);
  mesh.Hidden = simplices.Hidden.data();
  withAccess(mesh,
    [&](const auto& access)
    {
      for (std::int64_t cell = 0; cell < mesh.Cells; ++cell)
      {
        for (int i = 0; i < access.Corners; ++i)
        {
          const auto id = std::size_t(access.ids(cell)[i]);
          simplices.Hidden[std::size_t(cell)] |= (unsigned char)(markedPoints[id]);
        }
      }
    });
}

} // namespace tipp
