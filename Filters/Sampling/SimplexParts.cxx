// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SimplexParts.h"

#include "Vtk/Compatibility.h"
#include "Vtk/DataSets.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
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
#include <numeric>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

// Convex cells are divided into simplices by "pulling" the lexicographically least corner: every
// face is triangulated from its own least corner, so that both cells at a face agree. As in
// Dompierre, Labbe, Vallet, Camarero, How to Subdivide Pyramids, Prisms and Hexahedra into
// Tetrahedra, 1999, with coordinates instead of vertex numbers.

/// A corner of a cell: its coordinates and its point id.
struct Corner
{
  Point3 Position;
  std::int64_t Id;
};
using Face = std::vector<int>; ///< corners in order around the face

/// The index in `face` of its lexicographically least corner.
std::size_t leastOf(const std::vector<Corner>& corners, const Face& face)
{
  const auto less = [&](int a, int b)
  { return lexicographicLess(corners[std::size_t(a)].Position, corners[std::size_t(b)].Position); };
  return std::size_t(std::min_element(face.begin(), face.end(), less) - face.begin());
}

Point3 crossProduct(Point3 a, Point3 b, Point3 c)
{
  const Point3 u{ b.x - a.x, b.y - a.y, b.z - a.z };
  const Point3 v{ c.x - a.x, c.y - a.y, c.z - a.z };
  return { u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x };
}

/// Whether the triangles abc and acd of a quad have the same orientation.
bool cutsInside(Point3 a, Point3 b, Point3 c, Point3 d)
{
  const Point3 u = crossProduct(a, b, c);
  const Point3 v = crossProduct(a, c, d);
  return u.x * v.x + u.y * v.y + u.z * v.z > 0;
}

/// The faces of VTK_HEXAHEDRON, VTK_VOXEL, VTK_WEDGE or VTK_PYRAMID; none for other types.
const std::vector<Face>& facesOf(int cellType)
{
  static const std::vector<Face> none;
  static const std::vector<Face> hexahedron = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 },
    { 3, 7, 6, 2 }, { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
  static const std::vector<Face> voxel = { { 0, 2, 6, 4 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
    { 2, 3, 7, 6 }, { 0, 1, 3, 2 }, { 4, 5, 7, 6 } };
  static const std::vector<Face> wedge = { { 0, 1, 2 }, { 3, 5, 4 }, { 0, 3, 4, 1 }, { 1, 4, 5, 2 },
    { 2, 5, 3, 0 } };
  static const std::vector<Face> pyramid = { { 0, 3, 2, 1 }, { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 },
    { 3, 0, 4 } };
  switch (cellType)
  {
    case VTK_HEXAHEDRON:
      return hexahedron;
    case VTK_VOXEL:
      return voxel;
    case VTK_WEDGE:
      return wedge;
    case VTK_PYRAMID:
      return pyramid;
    default:
      return none;
  }
}

/// Appends triangles to `ids`, three point ids each. A quad with a reflex corner is cut along the
/// diagonal inside; other polygons must be convex.
void cutPolygon(const std::vector<Corner>& corners, std::vector<std::int64_t>& ids)
{
  Face face(corners.size());
  std::iota(face.begin(), face.end(), 0);
  std::rotate(face.begin(), face.begin() + std::ptrdiff_t(leastOf(corners, face)), face.end());
  const auto position = [&](std::size_t i) { return corners[std::size_t(face[i])].Position; };
  if (face.size() == 4 && !cutsInside(position(0), position(1), position(2), position(3)))
  {
    std::rotate(face.begin(), face.begin() + 1, face.end());
  }
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
  {
    for (const std::size_t corner : { std::size_t(0), i, i + 1 })
    {
      ids.push_back(corners[std::size_t(face[corner])].Id);
    }
  }
}

/// Appends tetrahedra to `ids`, four point ids each.
void cutPolyhedron(const std::vector<Corner>& corners, const std::vector<Face>& faces,
  std::vector<std::int64_t>& ids)
{
  Face all(corners.size());
  std::iota(all.begin(), all.end(), 0);
  const int apex = int(leastOf(corners, all));
  for (Face face : faces)
  {
    if (std::find(face.begin(), face.end(), apex) != face.end())
    {
      continue;
    }
    std::rotate(face.begin(), face.begin() + std::ptrdiff_t(leastOf(corners, face)), face.end());
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
    {
      for (const int corner : { apex, face[0], face[i], face[i + 1] })
      {
        ids.push_back(corners[std::size_t(corner)].Id);
      }
    }
  }
}

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
    // Compares each byte with the next one, which is fastest for many bytes.
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
        cutPolygon(this->Corners, this->Parts.Triangles.Ids);
        break;
      case VTK_HEXAHEDRON:
      case VTK_VOXEL:
      case VTK_WEDGE:
      case VTK_PYRAMID:
        this->loadCorners(cell);
        cutPolyhedron(this->Corners, facesOf(type), this->Parts.Tetrahedra.Ids);
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
  std::vector<Corner> Corners;
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

SimplexParts makeTriangles(
  vtkPointSet* mesh, const std::string& name, const std::vector<int>& axes, int threads)
{
  SimplexParts parts = makeSimplices(mesh, axes, threads);
  if (parts.Tetrahedra.Mesh.Cells > 0)
  {
    throw std::runtime_error(name + " has cells with a volume: give a surface.");
  }
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
