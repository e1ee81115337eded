// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Points/ReadPoints.h"
#include "Vtk/VtkFiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

using Edge = std::array<std::int64_t, 2>;

/// Reads all blocks of a text file into one table.
ConstraintTable readText(const std::string& path)
{
  SegmentRows rows(path);
  ConstraintTable all;
  ConstraintTable part;
  while (rows.next(part))
  {
    const auto first = std::int64_t(all.XY.size() / 2);
    all.XY.insert(all.XY.end(), part.XY.begin(), part.XY.end());
    all.Height.insert(all.Height.end(), part.Height.begin(), part.Height.end());
    for (const Edge& edge : part.Edges)
    {
      all.Edges.push_back({ first + edge[0], first + edge[1] });
    }
  }
  all.PolygonBegin = all.Edges.size();
  return all;
}

ConstraintTable readBoundaries(const std::string& path)
{
  AdcircGrid grid = readAdcircGridAndBoundaries(path);
  if (grid.BoundaryEdges.empty())
  {
    throw IOError(path, "has no boundaries.");
  }
  ConstraintTable table;
  table.XY = std::move(grid.XY);
  table.Edges = std::move(grid.BoundaryEdges);
  table.PolygonBegin = table.Edges.size();
  return table;
}

/// Whether GDAL reads files with this extension.
bool isVectorFile(const std::string& extension)
{
  const std::array<const char*, 5> extensions{ ".gpkg", ".shp", ".geojson", ".json", ".fgb" };
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

} // namespace

SegmentRows::SegmentRows(const std::string& path)
  : Path(path)
  , Rows(openPointStream({ path }, { "0", "1" }))
{
  const std::size_t columns = this->Rows->columns().size();
  if (columns != 0 && columns != 2 && columns != 4)
  {
    throw IOError(path,
      "has " + std::to_string(2 + columns) +
        " columns; segments take two, which are ids of points, four, x and y of both ends, or six, "
        "x, y and z of both.");
  }
}

bool SegmentRows::isFor(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".csv" || extension == ".txt";
}

void SegmentRows::takeIds(const PointBlock& block, ConstraintTable& table) const
{
  for (std::size_t i = 0; i < block.size(); ++i)
  {
    Edge edge;
    for (std::size_t end = 0; end < 2; ++end)
    {
      const double id = block.XY[2 * i + end];
      constexpr double most = 9007199254740992.0; // 2^53
      if (!(id >= 0 && id <= most) || std::floor(id) != id)
      {
        throw IOError(this->Path,
          "has two columns, which are ids of points, but one of segment " +
            std::to_string(block.First + std::int64_t(i)) +
            " is no whole number; give ids counted from 0, or the four coordinates of both ends.");
      }
      edge[end] = std::int64_t(id);
    }
    table.Edges.push_back(edge);
  }
}

bool SegmentRows::next(ConstraintTable& table)
{
  constexpr std::size_t most = 16384;
  table = ConstraintTable();
  PointBlock block;
  if (!this->Rows->next(block, most))
  {
    return false;
  }
  if (block.Columns.empty())
  {
    this->takeIds(block, table);
  }
  const bool hasHeights = block.Columns.size() == 4;
  for (std::size_t i = 0; !block.Columns.empty() && i < block.size(); ++i)
  {
    const auto column = [&](std::size_t c) { return block.Columns[c][i]; };
    const auto id = std::int64_t(table.XY.size() / 2);
    const std::size_t end = hasHeights ? 1 : 0; // column of x of the second end
    table.XY.insert(
      table.XY.end(), { block.XY[2 * i], block.XY[2 * i + 1], column(end), column(end + 1) });
    if (hasHeights)
    {
      table.Height.insert(table.Height.end(), { column(0), column(3) });
    }
    table.Edges.push_back({ id, id + 1 });
  }
  table.PolygonBegin = table.Edges.size();
  return true;
}

#ifndef TIPP_HAVE_GDAL

ConstraintTable readVectorFile(const std::string& path)
{
  throw IOError(path,
    "needs GDAL, and this program was built without it; install libgdal-dev and build it again, or "
    "give .csv, .poly or .vtp.");
}

#endif

ConstraintTable readConstraintFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension == ".poly")
  {
    return readPolyFile(path);
  }
  if (SegmentRows::isFor(path))
  {
    return readText(path);
  }
  if (isAdcircFile(path))
  {
    return readBoundaries(path);
  }
  if (isVectorFile(extension))
  {
    return readVectorFile(path);
  }
  if (isVtkFile(path))
  {
    return readVtkConstraints(path);
  }
  throw IOError(path,
    "has no extension that tells a kind of constraints; use .poly, .csv, .txt, .14, .grd, .gpkg, "
    ".shp, .geojson, .fgb, .vtp or another kind of VTK file.");
}

} // namespace tipp
