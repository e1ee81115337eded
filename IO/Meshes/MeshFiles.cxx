// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshFiles.h"

#include "Adcirc/AdcircGrid.h"
#include "Arrays/FindNeighbors.h"
#include "Arrays/Scalar.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Npy/NpyFile.h"
#include "Partitioned/PieceFormat.h"
#include "Partitioned/ReadPiece.h"
#include "Points/ReadPoints.h"
#include "Vtk/CellArrays.h"
#include "Vtk/DataSets.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

constexpr const char* neighborsName = "NeighborIds";

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

void setIds(vtkFieldData* data, const char* name, const std::vector<std::int64_t>& ids, int each)
{
  if (!ids.empty())
  {
    const auto array = borrow<vtkTypeInt64Array>(ids.data(), ids.size());
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

template <typename Array>
vtkSmartPointer<vtkCellArray> makeCells(vtkSmartPointer<Array> ids, std::size_t corners)
{
  using Id = typename Array::ValueType;
  const std::size_t count = std::size_t(ids->GetNumberOfValues()) / corners;
  vtkNew<Array> offsets;
  offsets->SetNumberOfValues(vtkIdType(count) + 1);
  for (std::size_t i = 0; i <= count; ++i)
  {
    offsets->SetValue(vtkIdType(i), Id(corners) * Id(i));
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets.Get(), ids.Get());
  return cells;
}

/// Cells in the memory of the ids, except for 32-bit ids that are too many for 32-bit offsets.
template <typename Id>
vtkSmartPointer<vtkCellArray> makeCells(const Id* ids, std::size_t count, std::size_t corners)
{
  const std::size_t size = count * corners;
  if constexpr (sizeof(Id) == sizeof(std::int32_t))
  {
    if (size <= std::size_t(std::numeric_limits<Id>::max()))
    {
      return makeCells(borrow<vtkTypeInt32Array>(ids, size), corners);
    }
    const auto wide = vtkSmartPointer<vtkTypeInt64Array>::New();
    wide->SetNumberOfValues(vtkIdType(size));
    std::copy(ids, ids + size, wide->GetPointer(0));
    return makeCells(wide, corners);
  }
  else
  {
    return makeCells(borrow<vtkTypeInt64Array>(ids, size), corners);
  }
}

/// Returns work(ids) for the view's pointer to ids, of whichever size.
template <typename Work>
auto withIds(TrianglesView triangles, const Work& work)
{
  return triangles.ids32() ? work(triangles.ids32()) : work(triangles.ids64());
}

vtkSmartPointer<vtkCellArray> makeCells(TrianglesView triangles)
{
  return withIds(triangles, [&](const auto* ids) { return makeCells(ids, triangles.size(), 3); });
}

} // namespace

vtkSmartPointer<vtkPolyData> makePolyData(const PointTable& points, TrianglesView triangles)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  setPoints(points, data);
  data->SetPolys(makeCells(triangles));
  return data;
}

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
  if (!name.empty())
  {
    array->SetName(name.c_str());
  }
  return array;
}

vtkSmartPointer<vtkDataArray> newArray(Scalar type)
{
  return vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeOf(type)));
}

void setGlobalIds(
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
vtkSmartPointer<vtkCellArray> cellsOf(Piece& piece)
{
  return makeCells(takeOver(std::move(piece.Connectivity), vtkSmartPointer<Array>::New(), 1,
                     piece.Cells * piece.CellSize),
    std::size_t(piece.CellSize));
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
  setGlobalIds(std::move(piece.PointIds), piece.Points, pointIdsName, grid->GetPointData());
  addGhosts(std::move(piece.PointGhosts), piece.Points, grid->GetPointData());
  grid->SetCells(piece.CellSize == 3 ? VTK_TRIANGLE : VTK_TETRA,
    piece.WideIds ? cellsOf<vtkTypeInt64Array>(piece) : cellsOf<vtkTypeInt32Array>(piece));
  setGlobalIds(std::move(piece.CellIds), piece.Cells, cellIdsName, grid->GetCellData());
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

/// Reads an .npy file of cells: `corners` ids in each row. `what` names the cells in messages.
std::vector<std::int64_t> readNpyIds(const std::string& path, int corners, const char* what)
{
  NpyReader reader(path);
  if (reader.columns() != corners || reader.isFloat())
  {
    throw IOError(path,
      std::string("does not hold ") + what + "; save m x " + std::to_string(corners) +
        " integers of 32 or 64 bits.");
  }
  std::vector<std::int64_t> all(std::size_t(corners * reader.rows()));
  switch (reader.type())
  {
    case Scalar::Int32:
      readIds<std::int32_t>(reader, all);
      break;
    case Scalar::UInt32:
      readIds<std::uint32_t>(reader, all);
      break;
    default: // as stored; unsigned ids from 2^63 on become negative, and so remain out of range
      reader.read(all.data(), all.size() * sizeof(std::int64_t));
  }
  return all;
}

/// The point ids of a data set's cells, which must all be triangles or all tetrahedra.
std::vector<std::int64_t> cellIdsOf(vtkDataSet* data, int type, const std::string& path)
{
  const bool areTriangles = type == VTK_TRIANGLE;
  std::vector<std::int64_t> all;
  all.reserve((areTriangles ? 3 : 4) * std::size_t(data->GetNumberOfCells()));
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (data->GetCellType(cell) != type)
    {
      throw IOError(path,
        std::string("holds a cell that is not a ") + (areTriangles ? "triangle" : "tetrahedron") +
          " (cell " + std::to_string(cell) +
          (areTriangles ? "); triangulate its cells first." : ")."));
    }
    data->GetCellPoints(cell, ids);
    all.insert(all.end(), ids->begin(), ids->end());
  }
  return all;
}

/// The data set's array NeighborIds; empty unless it has one component per corner of a cell.
std::vector<std::int64_t> neighborsOf(vtkDataSet* data, int corners)
{
  vtkDataArray* const array = data->GetCellData()->GetArray(neighborsName);
  if (!array || array->GetNumberOfComponents() != corners)
  {
    return {};
  }
  const PlainIds plain = PlainIds(array).widened();
  const auto* const ids = static_cast<const std::int64_t*>(plain.data());
  return { ids, ids + plain.count() };
}

} // namespace

TriangleMesh readMesh(const std::string& path)
{
  switch (openerOf(path, Use::Triangles))
  {
    case Opener::Npy:
      return { readNpyIds(path, 3, "triangles"), {}, {} };
    case Opener::Adcirc:
    {
      AdcircGrid grid = readAdcircGrid(path);
      return { std::move(grid.Triangles), std::move(grid.XY), {} };
    }
    case Opener::Vtk:
    {
      const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
      std::vector<std::int64_t> ids = cellIdsOf(data, VTK_TRIANGLE, path);
      return { std::move(ids), std::move(pointsOf(data).XY), neighborsOf(data, 3) };
    }
    default:
      refuseKind(path,
        "has no extension that tells a kind of mesh file; use " +
          listFormats(Use::Triangles, " or one of VTK's") + ".");
  }
}

namespace
{

template <typename Id>
bool writeNpy(const std::string& path, const Id* ids, std::size_t cells, std::size_t corners,
  const MeshOptions& options)
{
  NpyWriter writer(path, "<i8", { std::int64_t(cells), std::int64_t(corners) }, options.Before);
  constexpr std::size_t chunkSize = 1 << 16;
  std::vector<std::int64_t> chunk;
  for (std::size_t first = 0; first < corners * cells; first += chunkSize)
  {
    chunk.assign(ids + first, ids + std::min(corners * cells, first + chunkSize));
    writer.write(chunk.data(), chunk.size() * sizeof(std::int64_t));
  }
  if (options.Aborted && options.Aborted())
  {
    return false;
  }
  writer.close();
  return true;
}

bool writeWithIds(const std::string& path, vtkPointSet* data, int corners,
  const std::vector<std::int64_t>& neighbors, const MeshOptions& options)
{
  setIds(data->GetPointData(), "RepresentativePointId", options.Representatives, 1);
  setIds(data->GetCellData(), neighborsName, neighbors, corners);
  return writeXmlFile(path, options.Before, data, options.Aborted);
}

/// Writes a .vtu file of cells of one type.
bool writeGrid(const std::string& path, const PointTable& points, int type, vtkCellArray* cells,
  const std::vector<std::int64_t>& neighbors, const MeshOptions& options)
{
  vtkNew<vtkUnstructuredGrid> data;
  setPoints(points, data);
  data->SetCells(type, cells);
  const int corners = type == VTK_TRIANGLE ? 3 : 4;
  return writeWithIds(path, data, corners, neighbors, options);
}

} // namespace

bool writeMesh(const std::string& path, const PointTable& points, TrianglesView triangles,
  const MeshOptions& options)
{
  const Opener opener = openerOf(path, Use::WritesTriangles);
  if (opener == Opener::None)
  {
    throw IOError(path,
      "has no extension that tells a kind of mesh file; use " + listFormats(Use::WritesTriangles) +
        ".");
  }
  if (opener == Opener::Npy)
  {
    return withIds(triangles,
      [&](const auto* ids) { return writeNpy(path, ids, triangles.size(), 3, options); });
  }
  if (opener == Opener::Adcirc)
  {
    return writeAdcircGrid(
      path, points, triangles, options.AdcircLike, options.Before, options.Aborted);
  }
  std::vector<std::int64_t> neighbors(options.Neighbors ? 3 * triangles.size() : 0);
  if (options.Neighbors)
  {
    withIds(
      triangles, [&](const auto* ids) { findNeighbors(ids, triangles.size(), neighbors.data()); });
  }
  return extensionOf(path) == ".vtp"
    ? writeWithIds(path, makePolyData(points, triangles), 3, neighbors, options)
    : writeGrid(path, points, VTK_TRIANGLE, makeCells(triangles), neighbors, options);
}

std::size_t requireElevation(const PointTable& points, const std::string& path)
{
  const std::vector<std::string> names = points.names();
  const std::size_t found = findElevation(names);
  if (found == names.size())
  {
    throw IOError(path, "has no third coordinate; name a column z.");
  }
  return found;
}

bool writeTetrahedra(const std::string& path, PointTable points, const std::int32_t* ids,
  std::size_t tetrahedra, const std::vector<std::int64_t>& neighbors, const MeshOptions& options)
{
  const Opener opener = openerOf(path, Use::WritesTetrahedra);
  if (opener == Opener::Npy)
  {
    return writeNpy(path, ids, tetrahedra, 4, options);
  }
  if (opener != Opener::Vtk)
  {
    throw IOError(path,
      "has no extension that tells a kind of file of tetrahedra; use " +
        listFormats(Use::WritesTetrahedra) + ".");
  }
  points.Columns[requireElevation(points, path)].Name = "z"; // makes it the third coordinate
  return writeGrid(path, points, VTK_TETRA, makeCells(ids, tetrahedra, 4), neighbors, options);
}

bool holdsTetrahedra(const std::string& path)
{
  if (isOpenedBy(path, Opener::Npy))
  {
    const NpyReader reader(path);
    return reader.columns() == 4 && !reader.isFloat();
  }
  if (extensionOf(path) != ".vtu" && extensionOf(path) != ".vtk")
  {
    return false;
  }
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  return data->GetNumberOfCells() > 0 && data->GetCellType(0) == VTK_TETRA;
}

StoredTetrahedra readTetrahedra(const std::string& path)
{
  if (isOpenedBy(path, Opener::Npy))
  {
    return { readNpyIds(path, 4, "tetrahedra"), {}, {} };
  }
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  StoredTetrahedra mesh;
  mesh.Ids = cellIdsOf(data, VTK_TETRA, path);
  mesh.XYZ.resize(3 * std::size_t(data->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    data->GetPoint(i, &mesh.XYZ[3 * std::size_t(i)]);
  }
  mesh.Neighbors = neighborsOf(data, 4);
  return mesh;
}

} // namespace tipp
