// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatVtu.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Flat/VtuHeader.h"
#include "Vtk/CellTypeName.h"

#include <algorithm>

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
            ") where all must be triangles or all tetrahedra; 'tipp flatten' cuts other cells into "
            "these.");
      }
    });
  return first == triangleType ? 3 : 4;
}

template <typename Value>
void checkOffsets(const InputFile& file, const RawArray& offsets, int cellSize)
{
  forEach<Value>(file, offsets,
    [&](std::int64_t cell, Value offset)
    {
      if (std::int64_t(offset) != (cell + 1) * cellSize)
      {
        throw IOError(file.path(),
          "gives cell " + std::to_string(cell) + " other than " + std::to_string(cellSize) +
            " vertices; copy or write it again.");
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
  VtuHeader header = readVtuHeader(file);
  FlatMesh mesh;
  mesh.Path = path;
  mesh.CellSize = checkTypes(file, header.Types);
  if (!isId(header.Offsets) || !isId(header.Connectivity))
  {
    throw IOError(path,
      "holds its cells as other than 32-bit or 64-bit signed integers; 'tipp flatten' makes a flat "
      "mesh of it.");
  }
  if (header.Offsets.Type == Scalar::Int32)
  {
    checkOffsets<std::int32_t>(file, header.Offsets, mesh.CellSize);
  }
  else
  {
    checkOffsets<std::int64_t>(file, header.Offsets, mesh.CellSize);
  }
  if (header.Connectivity.Tuples != header.Cells * mesh.CellSize)
  {
    throw IOError(path,
      "holds " + std::to_string(header.Connectivity.Tuples) + " vertex ids for " +
        std::to_string(header.Cells) + " cells of " + std::to_string(mesh.CellSize) +
        "; copy or write it again.");
  }
  const RawArray& points = header.Coordinates;
  if (points.Components != 3 || (points.Type != Scalar::Float32 && points.Type != Scalar::Float64))
  {
    throw IOError(path,
      "holds points that are not three coordinates of Float32 or Float64; 'tipp flatten' makes a "
      "flat mesh of it.");
  }
  mesh.Points = points;
  mesh.Cells = header.Connectivity;
  mesh.Cells.Components = mesh.CellSize;
  mesh.Cells.Tuples = header.Cells;
  mesh.PointData = std::move(header.PointData);
  mesh.CellData = std::move(header.CellData);
  return mesh;
}

bool isFlatVtu(const std::string& path)
{
  try
  {
    readVtuHeader(InputFile(path));
    return true;
  }
  catch (const IOError&)
  {
    return false;
  }
}

} // namespace tipp
