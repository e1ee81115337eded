// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshFiles.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/PendingOutput.h"
#include "Npy/NpyFile.h"
#include "Vtk/ReadDataSet.h"
#include "Vtk/VtkFiles.h"
#include "Vtk/WriteXmlFile.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

// VTK's writers take non-const arrays but only read them, so the const_cast is safe. std::int64_t
// and VTK's 64-bit integer differ only in name (long and long long).
template <typename Array, typename Value>
vtkSmartPointer<Array> borrow(const Value* values, std::size_t count)
{
  auto array = vtkSmartPointer<Array>::New();
  using Same = typename Array::ValueType;
  static_assert(sizeof(Same) == sizeof(Value));
  array->SetArray(reinterpret_cast<Same*>(const_cast<Value*>(values)), vtkIdType(count), 1);
  return array;
}

const PointTable::Column* findZ(const PointTable& points)
{
  for (const PointTable::Column& column : points.Columns)
  {
    if (column.Name == "z" || column.Name == "Z")
    {
      return &column;
    }
  }
  return nullptr;
}

void setIds(vtkFieldData* data, const char* name, const std::vector<std::int64_t>* ids, int each)
{
  if (ids && !ids->empty())
  {
    const auto array = borrow<vtkTypeInt64Array>(ids->data(), ids->size());
    array->SetNumberOfComponents(each);
    array->SetName(name);
    data->AddArray(array);
  }
}

void setPoints(const PointTable& table, vtkPointSet* data)
{
  const std::size_t count = table.size();
  const PointTable::Column* const z = findZ(table);
  vtkNew<vtkDoubleArray> xyz;
  xyz->SetNumberOfComponents(3);
  xyz->SetNumberOfTuples(vtkIdType(count));
  double* const to = xyz->GetPointer(0);
  for (std::size_t i = 0; i < count; ++i)
  {
    to[3 * i] = table.XY[2 * i];
    to[3 * i + 1] = table.XY[2 * i + 1];
    to[3 * i + 2] = z ? z->Values[i] : 0;
  }
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  data->SetPoints(points);
  for (const PointTable::Column& column : table.Columns)
  {
    if (&column != z)
    {
      const auto array = borrow<vtkDoubleArray>(column.Values.data(), count);
      array->SetName(column.Name.c_str());
      data->GetPointData()->AddArray(array);
    }
  }
}

void setData(const MeshData& more, vtkPointSet* data)
{
  setIds(data->GetPointData(), "RepresentativePointId", more.Representatives, 1);
  setIds(data->GetCellData(), "NeighborIds", more.Neighbors, 3);
}

template <typename Array, typename Id>
vtkSmartPointer<vtkCellArray> makeCells(const Id* ids, std::size_t triangles)
{
  vtkNew<Array> offsets;
  offsets->SetNumberOfValues(vtkIdType(triangles) + 1);
  for (std::size_t i = 0; i <= triangles; ++i)
  {
    offsets->SetValue(vtkIdType(i), Id(3 * i));
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const auto connectivity = borrow<Array>(ids, 3 * triangles);
  cells->SetData(offsets.Get(), connectivity.Get());
  return cells;
}

vtkSmartPointer<vtkCellArray> makeCells(TrianglesView triangles)
{
  // 32-bit offsets end at a third of the triangles that 32-bit ids allow.
  constexpr std::size_t limit = (std::size_t(1) << 31) / 3;
  if (triangles.ids32() && triangles.size() < limit)
  {
    return makeCells<vtkTypeInt32Array>(triangles.ids32(), triangles.size());
  }
  if (triangles.ids64())
  {
    return makeCells<vtkTypeInt64Array>(triangles.ids64(), triangles.size());
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->Use64BitStorage();
  cells->AllocateExact(vtkIdType(triangles.size()), 3 * vtkIdType(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    cells->InsertNextCell({ triangles.id(i, 0), triangles.id(i, 1), triangles.id(i, 2) });
  }
  return cells;
}

} // namespace

vtkSmartPointer<vtkPolyData> makePolyData(
  const PointTable& points, TrianglesView triangles, const MeshData& more)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  setPoints(points, data);
  data->SetPolys(makeCells(triangles));
  setData(more, data);
  return data;
}

vtkSmartPointer<vtkUnstructuredGrid> makeUnstructuredGrid(
  const PointTable& points, TrianglesView triangles, const MeshData& more)
{
  auto data = vtkSmartPointer<vtkUnstructuredGrid>::New();
  setPoints(points, data);
  data->SetCells(VTK_TRIANGLE, makeCells(triangles));
  setData(more, data);
  return data;
}

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
  if (isAdcircFile(path))
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

namespace
{

bool isAborted(const MeshOptions& options)
{
  return options.Aborted && options.Aborted();
}

bool writeNpy(const std::string& path, TrianglesView triangles, const MeshOptions& options)
{
  NpyWriter writer(path, "<i8", { std::int64_t(triangles.size()), 3 }, options.Before);
  constexpr std::size_t chunkSize = 1 << 15;
  std::vector<std::int64_t> chunk(3 * std::min(chunkSize, triangles.size()));
  for (std::size_t first = 0; first < triangles.size(); first += chunkSize)
  {
    const std::size_t size = std::min(chunkSize, triangles.size() - first);
    for (std::size_t i = 0; i < 3 * size; ++i)
    {
      chunk[i] = triangles.id(first + i / 3, int(i % 3));
    }
    writer.write(chunk.data(), 3 * size * sizeof(std::int64_t));
  }
  if (isAborted(options))
  {
    return false;
  }
  writer.close();
  return true;
}

template <typename Writer>
bool writeXml(const std::string& path, vtkDataSet* data, const MeshOptions& options)
{
  PendingFile pending(path, options.Before);
  writeXmlFile<Writer>(path, pending, data);
  if (isAborted(options))
  {
    return false;
  }
  pending.commit();
  return true;
}

std::vector<std::int64_t> neighborsOf(TrianglesView triangles)
{
  std::vector<std::int64_t> neighbors(3 * triangles.size());
  triangles.ids32() ? findNeighbors(triangles.ids32(), triangles.size(), neighbors.data())
                    : findNeighbors(triangles.ids64(), triangles.size(), neighbors.data());
  return neighbors;
}

} // namespace

bool isMeshFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".npy" || extension == ".vtp" || extension == ".vtu" || isAdcircFile(path);
}

bool writeMesh(const std::string& path, const PointTable& points, TrianglesView triangles,
  const MeshOptions& options)
{
  const std::string extension = extensionOf(path);
  if (extension == ".npy")
  {
    return writeNpy(path, triangles, options);
  }
  if (isAdcircFile(path))
  {
    return writeAdcircGrid(
      path, points, triangles, options.AdcircLike, options.Before, options.Aborted);
  }
  const std::vector<std::int64_t> neighbors =
    options.Neighbors ? neighborsOf(triangles) : std::vector<std::int64_t>();
  const MeshData more{ &options.Representatives, &neighbors };
  if (extension == ".vtp")
  {
    const auto data = makePolyData(points, triangles, more);
    return writeXml<vtkXMLPolyDataWriter>(path, data, options);
  }
  if (extension == ".vtu")
  {
    const auto data = makeUnstructuredGrid(points, triangles, more);
    return writeXml<vtkXMLUnstructuredGridWriter>(path, data, options);
  }
  throw IOError(
    path, "has no extension that tells a kind of mesh file; use .npy, .vtp, .vtu or .14.");
}

} // namespace tipp
