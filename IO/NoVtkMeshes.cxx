// SPDX-License-Identifier: BSD-3-Clause
// Replaces Meshes/VtkMeshes.cxx in a build without VTK: of VTK's files, it reads the .vtu files of
// triangles or tetrahedra that can be read in place.
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Meshes/MeshFiles.h"
#include "NoVtk.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

FlatMesh openVtu(const std::string& path)
{
  if (!isFlatMesh(path))
  {
    refuseVtkCells(path);
  }
  return openFlatMesh(path);
}

/// Reads the corners of all cells, which must have so many.
std::vector<std::int64_t> cellsOf(const FlatMesh& mesh, int corners)
{
  if (mesh.CellSize != corners)
  {
    throw IOError(mesh.Path,
      std::string("has cells that are not ") + (corners == 3 ? "triangles" : "tetrahedra") +
        "; give a file of these alone.");
  }
  std::vector<std::int64_t> ids;
  CellReader(mesh).read(0, mesh.Cells.Tuples, ids);
  return ids;
}

std::vector<std::int64_t> neighborsOf(const FlatMesh& mesh)
{
  for (const RawArray& array : mesh.CellData)
  {
    const bool isWhole = array.Type != Scalar::Float32 && array.Type != Scalar::Float64;
    if (array.Name == neighborIdsName && array.Components == mesh.CellSize && isWhole)
    {
      return valuesOf<std::int64_t>(array);
    }
  }
  return {};
}

} // namespace

TriangleMesh readVtkTriangles(const std::string& path)
{
  const FlatMesh mesh = openVtu(path);
  TriangleMesh result;
  result.Triangles = cellsOf(mesh, 3);
  const std::vector<double> points = valuesOf<double>(mesh.Points);
  const auto components = std::size_t(mesh.Points.Components);
  for (std::size_t i = 0; i < points.size(); i += components)
  {
    result.XY.insert(result.XY.end(), { points[i], points[i + 1] });
  }
  result.Neighbors = neighborsOf(mesh);
  return result;
}

bool holdsVtkTriangles(const std::string& path)
{
  const FlatMesh mesh = openVtu(path);
  return mesh.CellSize == 3 && mesh.Cells.Tuples > 0;
}

bool holdsVtkTetrahedra(const std::string& path)
{
  const FlatMesh mesh = openVtu(path);
  return mesh.CellSize == 4 && mesh.Cells.Tuples > 0;
}

StoredTetrahedra readVtkTetrahedra(const std::string& path)
{
  const FlatMesh mesh = openVtu(path);
  return { cellsOf(mesh, 4), valuesOf<double>(mesh.Points), neighborsOf(mesh) };
}

} // namespace tipp
