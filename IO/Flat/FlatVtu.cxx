// SPDX-License-Identifier: BSD-3-Clause
// Flat meshes in .vtu files and, without VTK, in .vtp files.
#include "Flat/FlatMesh.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/VtkXml.h"
#include "Flat/RawVtkFile.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

// VTK_TRIANGLE and VTK_TETRA.
constexpr int triangleType = 5;
constexpr int tetrahedronType = 10;

/// Calls check(index, value) for each value of an array, which is read block by block.
template <typename Value, typename Check>
void forEach(const InputFile& file, const RawArray& array, const Check& check)
{
  constexpr std::int64_t block = 1 << 17;
  std::vector<Value> values(std::size_t(std::min(block, array.Tuples)));
  for (std::int64_t first = 0; first < array.Tuples; first += block)
  {
    const auto size = std::size_t(std::min(block, array.Tuples - first));
    file.read(
      array.Offset + std::uint64_t(first) * sizeof(Value), values.data(), size * sizeof(Value));
    for (std::size_t i = 0; i < size; ++i)
    {
      check(first + std::int64_t(i), values[i]);
    }
  }
}

/// Returns the number of points per cell; throws IOError unless all cells are triangles or all are
/// tetrahedra.
int checkTypes(const InputFile& file, const RawArray& types)
{
  if (scalarSize(types.Type) != 1 || types.Components != 1)
  {
    throw IOError(file.path(), "holds cell types that are not one byte each; write it again.");
  }
  int first = triangleType;
  forEach<std::uint8_t>(file, types,
    [&](std::int64_t cell, std::uint8_t type)
    {
      first = cell == 0 ? type : first;
      if (type != first || (type != triangleType && type != tetrahedronType))
      {
        throw IOError(file.path(),
          "holds a cell (cell " + std::to_string(cell) + ", " + cellTypeName(type) +
            ") where all must be triangles or all tetrahedra; " + otherVtkAdvice(file.path()));
      }
    });
  return first == triangleType ? 3 : 4;
}

template <typename Value>
void checkOffsets(const InputFile& file, const RawArray& offsets, int cellSize, bool arePolygons)
{
  forEach<Value>(file, offsets,
    [&](std::int64_t cell, Value offset)
    {
      if (std::int64_t(offset) != (cell + 1) * cellSize)
      {
        throw IOError(file.path(),
          arePolygons ? "holds polygons that are not triangles; " + otherVtkAdvice(file.path())
                      : "gives cell " + std::to_string(cell) + " other than " +
              std::to_string(cellSize) + " vertices; copy or write it again.");
      }
    });
}

bool isId(const RawArray& array)
{
  return (array.Type == Scalar::Int32 || array.Type == Scalar::Int64) && array.Components == 1;
}

} // namespace

FlatMesh openFlatVtu(const std::string& path)
{
  const InputFile file(path);
  RawVtkFile raw = openRawVtkFile(file);
  requirePositions(raw, path);
  FlatMesh mesh;
  mesh.Path = path;
  const bool isPolyData = raw.Kind == "PolyData";
  mesh.CellSize = isPolyData ? 3 : checkTypes(file, raw.Types);
  RawCells& cells = raw.Cells;
  if (cells.Ids.Path.empty()) // a .vtp file without polygons
  {
    cells.Ids = cells.Offsets = { "", path, 0, Scalar::Int64, 1, 0 };
  }
  if (!isId(cells.Offsets) || !isId(cells.Ids))
  {
    throw IOError(path,
      "holds its cells as other than 32-bit or 64-bit signed integers; " + otherVtkAdvice(path));
  }
  cells.Offsets.Type == Scalar::Int32
    ? checkOffsets<std::int32_t>(file, cells.Offsets, mesh.CellSize, isPolyData)
    : checkOffsets<std::int64_t>(file, cells.Offsets, mesh.CellSize, isPolyData);
  if (cells.Ids.Tuples != cells.Count * mesh.CellSize)
  {
    throw IOError(path,
      "holds " + std::to_string(cells.Ids.Tuples) + " vertex ids for " +
        std::to_string(cells.Count) + " cells of " + std::to_string(mesh.CellSize) +
        "; copy or write it again.");
  }
  mesh.Cells = cells.Ids;
  mesh.Cells.Components = mesh.CellSize;
  mesh.Cells.Tuples = cells.Count;
  mesh.Points = raw.PointCount > 0 ? raw.Points : RawArray{ "", path, 0, Scalar::Float64, 3, 0 };
  mesh.PointData = std::move(raw.PointData);
  mesh.CellData = std::move(raw.CellData);
  mesh.OtherCells = raw.Vertices.Count + raw.Lines.Count;
  return mesh;
}

void requireNoOtherCells(const FlatMesh& mesh)
{
  if (mesh.OtherCells > 0)
  {
    throw IOError(mesh.Path,
      "holds vertices or lines beside its triangles; save the triangles alone, or " +
        otherVtkAdvice(mesh.Path));
  }
}

bool isFlatVtu(const std::string& path)
{
  try
  {
    const InputFile file(path);
    openRawVtkFile(file);
    return true;
  }
  catch (const IOError&)
  {
    return false;
  }
}

} // namespace tipp
