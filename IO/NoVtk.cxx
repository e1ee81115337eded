// SPDX-License-Identifier: BSD-3-Clause
// Replaces what reads VTK's files, in a build without VTK: of these, it reads the .vtu, .vtp and
// .vti files that can be read in place, as TIPP writes them.
#include "NoVtk.h"

#include "Constraints/ReadConstraintFile.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TemporaryPaths.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"
#include "Flat/FlatMesh.h"
#include "Flat/FlattenImage.h"
#include "Flat/RawVtkFile.h"
#include "Partitioning/PartitionMesh.h"
#include "Points/ReadPoints.h"
#include "Points/TableColumns.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace tipp
{
namespace
{

/// The expression of Python that reads the file.
std::string readingOf(const std::string& path)
{
  return "pyvista.read('" + shownPath(path) + "')";
}

/// Throws IOError. `advice`: what a line of Python with PyVista does with the file; `line`: that
/// line.
[[noreturn]] void refuse(
  const std::string& path, const std::string& advice, const std::string& line)
{
  if (!std::filesystem::is_regular_file(path))
  {
    throw IOError(path, "is not a file that can be read; check the name.");
  }
  const InputFile readable(path); // one without permission is reported as such
  throw IOError(path,
    "is a file that VTK reads, and this tipp was built without VTK; " + advice + ": python -c \"" +
      line + "\".");
}

/// Opens a file if it can be read in place.
std::optional<RawVtkFile> openRaw(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (!std::filesystem::is_regular_file(path) ||
    (extension != ".vtu" && extension != ".vtp" && extension != ".vti"))
  {
    return std::nullopt;
  }
  const InputFile file(path);
  try
  {
    return openRawVtkFile(file);
  }
  catch (const IOError&)
  {
    return std::nullopt;
  }
}

std::vector<double> pointsOf(const RawVtkFile& file, const std::string& path)
{
  requirePositions(file, path);
  if (file.Kind != "ImageData")
  {
    return valuesOf<double>(file.Points);
  }
  constexpr std::int64_t most = std::int64_t(1) << 31;
  return file.PointCount <= most ? imagePoints(file) : throw std::bad_alloc();
}

/// Adds a column for each component of an array, as a build with VTK names them.
void addColumns(const RawArray& array, PointTable& table)
{
  const std::vector<double> values = valuesOf<double>(array);
  const auto components = std::size_t(array.Components);
  for (std::size_t k = 0; k < components; ++k)
  {
    const std::string name = array.Name.empty() ? "array" : array.Name;
    PointTable::Column column;
    column.Name = components == 1 ? name : name + "_" + std::to_string(k);
    for (std::size_t i = k; i < values.size(); i += components)
    {
      column.Values.push_back(values[i]);
    }
    table.Columns.push_back(std::move(column));
  }
}

/// Appends the edges of cells: of lines between successive points, of polygons all around.
void addEdges(const RawCells& cells, bool areLines, std::int64_t points, const std::string& path,
  std::vector<std::array<std::int64_t, 2>>& edges)
{
  const std::vector<double> ids = valuesOf<double>(cells.Ids);
  std::size_t begin = 0;
  for (const double offset : valuesOf<double>(cells.Offsets))
  {
    const bool isInside = offset >= double(begin) && offset <= double(ids.size());
    const std::size_t end = isInside ? std::size_t(offset) : begin;
    for (std::size_t i = begin; i + (areLines ? 1 : 0) < end; ++i)
    {
      const std::size_t next = i + 1 < end ? i + 1 : begin;
      edges.push_back({ std::int64_t(ids[i]), std::int64_t(ids[next]) });
      if (!(ids[i] >= 0 && ids[i] < double(points) && ids[next] >= 0 && ids[next] < double(points)))
      {
        throw IOError(
          path, "has cells that refer to points that it lacks; copy or write it again.");
      }
    }
    if (!isInside)
    {
      throw IOError(
        path, "has offsets of cells that do not fit their ids; copy or write it again.");
    }
    begin = end;
  }
}

} // namespace

void refuseVtkCells(const std::string& path)
{
  refuse(path, "PyVista writes its cells",
    "import numpy, pyvista; numpy.save('cells.npy', *" + readingOf(path) +
      ".cast_to_unstructured_grid().cells_dict.values())");
}

void refuseVtkMesh(const std::string& path)
{
  if (const std::optional<RawVtkFile> file = openRaw(path); file && file->Kind == "ImageData")
  {
    throw IOError(
      path, "holds a vtkImageData, which stores no points; convert it with 'tipp flatten'.");
  }
  refuse(path, "PyVista makes a partitioned mesh of it",
    "import pyvista, tipp; tipp.write(" + readingOf(path) + ", 'mesh.tipp')");
}

PointTable readVtkPoints(const std::string& path)
{
  const std::optional<RawVtkFile> file = openRaw(path);
  if (!file)
  {
    refuse(path, "PyVista writes its points",
      "import numpy, pyvista; numpy.save('points.npy', " + readingOf(path) + ".points)");
  }
  const std::vector<double> points = pointsOf(*file, path);
  PointTable table;
  table.Columns.push_back({ "z", {} });
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    table.XY.insert(table.XY.end(), { points[i], points[i + 1] });
    table.Columns[0].Values.push_back(points[i + 2]);
  }
  for (const RawArray& array : file->PointData)
  {
    addColumns(array, table);
  }
  std::vector<std::string> names = table.names();
  makeDifferent(names); // an array may be called z, like the coordinate
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    table.Columns[i].Name = utf8Of(names[i]);
  }
  return table;
}

ConstraintTable readVtkConstraints(const std::string& path)
{
  const std::optional<RawVtkFile> file = openRaw(path);
  if (!file || file->Kind == "ImageData" || (file->Kind == "UnstructuredGrid" && !isFlatMesh(path)))
  {
    throw IOError(path,
      "is a file that VTK reads, and this tipp was built without VTK; give .csv, .poly or .14.");
  }
  const std::vector<double> points = pointsOf(*file, path);
  ConstraintTable table;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    table.XY.insert(table.XY.end(), { points[i], points[i + 1] });
    table.Height.push_back(points[i + 2]);
  }
  addEdges(file->Lines, true, file->PointCount, path, table.Edges);
  table.PolygonBegin = table.Edges.size();
  addEdges(file->Cells, false, file->PointCount, path, table.Edges);
  return table;
}

std::string cellTypeName(int type)
{
  return type == 8 ? "vtkPixel" : type == 11 ? "vtkVoxel" : "type " + std::to_string(type);
}

Flattened flattenVtkImage(const std::string& path)
{
  const std::optional<RawVtkFile> file = openRaw(path);
  if (!file || file->Kind != "ImageData")
  {
    refuseVtkMesh(path);
  }
  return flattenImage(*file, path);
}

PartitionStatistics partitionVtkFile(const std::string& path, const std::string& output,
  const PartitionOptions& options, vtkMultiProcessController*)
{
  Flattened flattened;
  const auto make = [&]
  {
    flattened = flattenVtkImage(path);
    return std::move(flattened.Content);
  };
  PartitionStatistics statistics = partitionInMemory(make, path, output, options);
  statistics.LeftOut = std::move(flattened.LeftOut);
  statistics.GhostCells = flattened.GhostCells;
  return statistics;
}

} // namespace tipp
