// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/ReadMesh.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Files/UnknownKind.h"
#include "Npy/NpyFile.h"
#include "Points/DataSetPoints.h"
#include "Vtk/ReadDataSet.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

template <typename Id>
void readIds(NpyReader& reader, std::vector<std::int64_t>& ids)
{
  constexpr std::size_t chunkSize = 1 << 16;
  std::vector<Id> chunk(std::min(chunkSize, ids.size()));
  for (std::size_t first = 0; first < ids.size(); first += chunkSize)
  {
    const std::size_t size = std::min(chunkSize, ids.size() - first);
    reader.read(chunk.data(), size * sizeof(Id));
    std::transform(chunk.begin(), chunk.begin() + std::ptrdiff_t(size),
      ids.begin() + std::ptrdiff_t(first), [](Id id) { return std::int64_t(id); });
  }
}

TriangleMesh readNpyMesh(const std::string& path)
{
  NpyReader reader(path);
  if (reader.columns() != 3 || reader.isFloat())
  {
    throw IOError(path, "does not hold triangles; save m x 3 integers of 32 or 64 bits.");
  }
  TriangleMesh mesh;
  mesh.Triangles.resize(3 * std::size_t(reader.rows()));
  switch (reader.type())
  {
    case NpyReader::Type::Int32:
      readIds<std::int32_t>(reader, mesh.Triangles);
      break;
    case NpyReader::Type::UInt32:
      readIds<std::uint32_t>(reader, mesh.Triangles);
      break;
    default: // as stored; unsigned ids from 2^63 on become negative, and so remain out of range
      reader.read(mesh.Triangles.data(), mesh.Triangles.size() * sizeof(std::int64_t));
  }
  return mesh;
}

/// VTK's readers use another class of 64-bit integers than its writers. Empty unless the array has
/// three integers per triangle.
std::vector<std::int64_t> neighborsOf(vtkDataArray* array)
{
  const int type = array->GetDataType();
  const bool isWide = type == VTK_LONG || type == VTK_LONG_LONG || type == VTK_ID_TYPE;
  if (!isWide || array->GetNumberOfComponents() != 3 ||
    array->GetDataTypeSize() != int(sizeof(std::int64_t)) || !array->HasStandardMemoryLayout())
  {
    return {};
  }
  const auto* const ids = static_cast<const std::int64_t*>(array->GetVoidPointer(0));
  return { ids, ids + array->GetNumberOfValues() };
}

TriangleMesh readVtkMesh(const std::string& path)
{
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  TriangleMesh mesh;
  const vtkIdType cells = data->GetNumberOfCells();
  mesh.Triangles.reserve(3 * std::size_t(cells));
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    if (data->GetCellType(cell) != VTK_TRIANGLE)
    {
      throw IOError(path,
        "holds a cell that is not a triangle (cell " + std::to_string(cell) +
          "); triangulate its cells first.");
    }
    data->GetCellPoints(cell, ids);
    mesh.Triangles.insert(mesh.Triangles.end(), ids->begin(), ids->end());
  }
  mesh.XY = std::move(pointsOf(data).XY);
  if (vtkDataArray* const neighbors = data->GetCellData()->GetArray("NeighborIds"))
  {
    mesh.Neighbors = neighborsOf(neighbors);
  }
  return mesh;
}

} // namespace

TriangleMesh readMesh(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension == ".npy")
  {
    return readNpyMesh(path);
  }
  if (extension == ".14" || extension == ".grd")
  {
    AdcircGrid grid = readAdcircGrid(path);
    return { std::move(grid.Triangles), std::move(grid.XY), {} };
  }
  if (isVtkFile(path))
  {
    return readVtkMesh(path);
  }
  refuseKind(
    path, "has no extension that tells a kind of mesh file; use .npy, .14, .grd or one of VTK's.");
}

} // namespace tipp
