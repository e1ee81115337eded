// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Points/ReadPoints.h"
#include "Vtk/ReadDataSet.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

using Edge = std::array<std::int64_t, 2>;

ConstraintTable readCsv(const std::string& path)
{
  const PointTable rows = readPoints(path, { "0", "1" });
  ConstraintTable table;
  if (rows.Columns.empty())
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      Edge edge;
      for (std::size_t end = 0; end < 2; ++end)
      {
        const double id = rows.XY[2 * i + end];
        constexpr double most = 9007199254740992.0; // 2^53
        if (!(id >= 0 && id <= most) || std::floor(id) != id)
        {
          throw IOError(path,
            "has two columns, which are ids of points, but one of segment " + std::to_string(i) +
              " is no whole number; give ids counted from 0, or the four coordinates of both "
              "ends.");
        }
        edge[end] = std::int64_t(id);
      }
      table.Edges.push_back(edge);
    }
  }
  else if (rows.Columns.size() == 2 || rows.Columns.size() == 4)
  {
    const bool hasHeights = rows.Columns.size() == 4;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const auto column = [&](std::size_t c) { return rows.Columns[c].Values[i]; };
      const auto id = std::int64_t(table.XY.size() / 2);
      const std::size_t end = hasHeights ? 1 : 0; // the column of the second end's x
      table.XY.insert(
        table.XY.end(), { rows.XY[2 * i], rows.XY[2 * i + 1], column(end), column(end + 1) });
      if (hasHeights)
      {
        table.Height.insert(table.Height.end(), { column(0), column(3) });
      }
      table.Edges.push_back({ id, id + 1 });
    }
  }
  else
  {
    throw IOError(path,
      "has " + std::to_string(2 + rows.Columns.size()) +
        " columns; segments take two, which are ids of points, four, x and y of both ends, or six, "
        "x, y and z of both.");
  }
  table.PolygonBegin = table.Edges.size();
  return table;
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

bool isLine(int cellType)
{
  return cellType == VTK_LINE || cellType == VTK_POLY_LINE;
}

bool isPolygon(int cellType)
{
  return cellType == VTK_POLYGON || cellType == VTK_TRIANGLE || cellType == VTK_QUAD;
}

ConstraintTable readVtk(const std::string& path)
{
  const auto data = readDataSet(path);
  ConstraintTable table;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    table.XY.insert(table.XY.end(), { p[0], p[1] });
    table.Height.push_back(p[2]);
  }
  std::vector<Edge> polygonEdges;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    const int type = data->GetCellType(c);
    if (!isLine(type) && !isPolygon(type))
    {
      continue;
    }
    data->GetCellPoints(c, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    std::vector<Edge>& edges = isLine(type) ? table.Edges : polygonEdges;
    for (vtkIdType i = 0; i + (isLine(type) ? 1 : 0) < count; ++i)
    {
      edges.push_back({ ids->GetId(i), ids->GetId((i + 1) % count) });
    }
  }
  table.PolygonBegin = table.Edges.size();
  table.Edges.insert(table.Edges.end(), polygonEdges.begin(), polygonEdges.end());
  return table;
}

/// Whether GDAL reads files with this extension.
bool isVectorFile(const std::string& extension)
{
  const std::array<const char*, 5> extensions{ ".gpkg", ".shp", ".geojson", ".json", ".fgb" };
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

} // namespace

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
  if (extension == ".csv" || extension == ".txt")
  {
    return readCsv(path);
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
    return readVtk(path);
  }
  throw IOError(path,
    "has no extension that tells a kind of constraints; use .poly, .csv, .txt, .14, .grd, .gpkg, "
    ".shp, .geojson, .fgb, .vtp or another kind of VTK file.");
}

} // namespace tipp
