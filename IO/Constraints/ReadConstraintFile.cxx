// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Models/TriangleFiles.h"
#include "Points/Longitudes.h"
#ifdef TIPP_HAVE_GDAL
#include "Gdal/GdalLibrary.h"
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

using Edge = std::array<std::int64_t, 2>;

[[noreturn]] void refuseWithoutLines(const std::string& path)
{
  throw IOError(
    path, "holds no lines or polygons, so it would have no effect; give a file that does.");
}

/// A .poly file of Shewchuk's Triangle (https://www.cs.cmu.edu/~quake/triangle.poly.html):
/// vertices, segments and holes; later lines are ignored. If the file has no vertices, they are
/// read from the .node file of the same name. Throws IOError.
ConstraintTable readPolyFile(const std::string& path)
{
  NumberRows rows(path, triangleFileKind, '#');
  TriangleVertices vertices = readTriangleVertices(rows);
  if (vertices.XY.empty())
  {
    NumberRows nodes(triangleFileBeside(path, ".node"), triangleFileKind, '#');
    vertices = readTriangleVertices(nodes);
  }
  const std::int64_t count = std::int64_t(vertices.XY.size() / 2);
  ConstraintTable table;
  table.XY = std::move(vertices.XY);
  const std::int64_t segments = nextTriangleCount(rows, "the number of segments");
  for (std::int64_t i = 0; i < segments; ++i)
  {
    nextTriangleRow(rows, 3, "a segment");
    const std::int64_t a = rows.integer(1);
    const std::int64_t b = rows.integer(2);
    if (std::min(a, b) < vertices.First || std::max(a, b) - vertices.First >= count)
    {
      rows.fail("names a vertex that is not given.");
    }
    table.Edges.push_back({ a - vertices.First, b - vertices.First });
  }
  table.PolygonBegin = table.Edges.size();
  const std::int64_t holes = nextTriangleCount(rows, "the number of holes");
  for (std::int64_t i = 0; i < holes; ++i)
  {
    nextTriangleRow(rows, 3, "a hole");
    table.Holes.push_back(rows.number(1));
    table.Holes.push_back(rows.number(2));
  }
  return table;
}

ConstraintTable readBoundaries(const std::string& path)
{
  AdcircGrid grid = readAdcircBoundaries(path);
  if (grid.BoundaryEdges.empty())
  {
    throw IOError(path, "has no boundaries.");
  }
  // Only the nodes of the boundaries: others are no part of the constraints.
  ConstraintTable table;
  constexpr std::int64_t unused = -1;
  std::vector<std::int64_t> ids(grid.XY.size() / 2, unused);
  for (auto& edge : grid.BoundaryEdges)
  {
    for (std::int64_t& node : edge)
    {
      std::int64_t& id = ids[std::size_t(node)];
      if (id == unused)
      {
        id = std::int64_t(table.XY.size() / 2);
        table.XY.push_back(grid.XY[2 * std::size_t(node)]);
        table.XY.push_back(grid.XY[2 * std::size_t(node) + 1]);
      }
      node = id;
    }
  }
  table.Edges = std::move(grid.BoundaryEdges);
  table.PolygonBegin = table.Edges.size();
  return table;
}

#ifdef TIPP_HAVE_GDAL

/// Collects the edges of geometries.
class VectorEdges
{
public:
  void add(OGRGeometryH geometry)
  {
    const OGRwkbGeometryType kind = kindOf(geometry);
    if (kind == wkbLineString)
    {
      this->addLine(geometry, this->Table.Edges);
      return;
    }
    // The rings of a polygon, or the members of a collection. Other kinds of geometry have none.
    const int parts = gdal().OGR_G_GetGeometryCount(geometry);
    for (int i = 0; i < parts; ++i)
    {
      const OGRGeometryH part = gdal().OGR_G_GetGeometryRef(geometry, i);
      kind == wkbPolygon ? this->addRing(part, i == 0) : this->add(part);
    }
  }

  ConstraintTable take()
  {
    ConstraintTable& table = this->Table;
    table.PolygonBegin = table.Edges.size();
    table.Edges.insert(table.Edges.end(), this->PolygonEdges.begin(), this->PolygonEdges.end());
    if (std::all_of(
          table.Height.begin(), table.Height.end(), [](double z) { return std::isnan(z); }))
    {
      table.Height.clear();
    }
    return std::move(table);
  }

private:
  static OGRwkbGeometryType kindOf(OGRGeometryH geometry)
  {
    return gdal().OGR_GT_Flatten(gdal().OGR_G_GetGeometryType(geometry));
  }

  /// Appends the edges of a line. Returns the index of its first point.
  std::size_t addLine(OGRGeometryH line, std::vector<Edge>& edges)
  {
    const auto first = std::int64_t(this->Table.XY.size() / 2);
    const int points = gdal().OGR_G_GetPointCount(line);
    const bool hasHeight = gdal().OGR_G_Is3D(line) != 0;
    for (int i = 0; i < points; ++i)
    {
      this->Table.XY.push_back(gdal().OGR_G_GetX(line, i));
      this->Table.XY.push_back(gdal().OGR_G_GetY(line, i));
      this->Table.Height.push_back(hasHeight ? gdal().OGR_G_GetZ(line, i) : std::nan(""));
      if (i > 0)
      {
        edges.push_back({ first + i - 1, first + i });
      }
    }
    return std::size_t(first);
  }

  void addRing(OGRGeometryH ring, bool isOuter)
  {
    std::vector<Edge> edges;
    const std::size_t first = this->addLine(ring, edges);
    const std::vector<double>& xy = this->Table.XY;
    double area = 0;
    for (const Edge& edge : edges)
    {
      const auto at = [&](std::int64_t id, std::size_t axis)
      { return xy[2 * std::size_t(id) + axis] - xy[2 * first + axis]; };
      area += at(edge[0], 0) * at(edge[1], 1) - at(edge[1], 0) * at(edge[0], 1);
    }
    for (Edge& edge : edges)
    {
      if ((area > 0) != isOuter)
      {
        std::swap(edge[0], edge[1]);
      }
      this->PolygonEdges.push_back(edge);
    }
  }

  ConstraintTable Table;
  std::vector<Edge> PolygonEdges;
};

/// Reads the lines and polygons of all layers with GDAL. Outer rings of polygons become
/// counter-clockwise, the others clockwise, whatever their orientation in the file; missing heights
/// are NaN. Throws IOError.
ConstraintTable readVectorFile(const std::string& path)
{
  VectorEdges edges;
  forFeatures(path,
    [&edges](OGRFeatureH, OGRGeometryH geometry)
    {
      if (geometry)
      {
        edges.add(geometry);
      }
    });
  return edges.take();
}

#else

ConstraintTable readVectorFile(const std::string& path)
{
#ifdef TIPP_WITHOUT_VTK
  const char* const others = ".csv, .poly or .14";
#else
  const char* const others = ".csv, .poly or .vtp";
#endif
  throw IOError(path,
    std::string("needs GDAL, and this program was built without it; build it with GDAL (Debian's "
                "libgdal-dev), or give ") +
      others + ".");
}

#endif

PointOptions segmentOptions()
{
  PointOptions options;
  options.AsIs = true;
  return options;
}

} // namespace

SegmentRows::SegmentRows(const std::string& path, int wrap)
  : Path(path)
  , Wrap(wrap)
  , Rows(openPointStream({ path }, segmentOptions()))
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
  return openerOf(path, Use::Constraints) == Opener::Text;
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

bool SegmentRows::next(ConstraintTable& table, std::size_t most)
{
  table = ConstraintTable();
  PointBlock block;
  if (!this->Rows->next(block, most))
  {
    if (this->IsEmpty)
    {
      refuseWithoutLines(this->Path);
    }
    return false;
  }
  this->IsEmpty = false;
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
  wrapLongitudes(this->Path, this->Wrap, table.XY);
  return true;
}

namespace
{

ConstraintTable readAnyKind(const std::string& path)
{
  switch (openerOf(path, Use::Constraints))
  {
    case Opener::Triangle:
      return readPolyFile(path);
    case Opener::Text:
    {
      ConstraintTable table;
      SegmentRows(path).next(table, std::numeric_limits<std::size_t>::max());
      return table;
    }
    case Opener::Adcirc:
      return readBoundaries(path);
    case Opener::Gdal:
      return readVectorFile(path);
    case Opener::Vtk:
      return readVtkConstraints(path);
    default:
      throw IOError(path,
        "has no extension that tells a kind of constraints; use " +
          listFormats(Use::Constraints, ", .vtp or another kind of VTK file") + ".");
  }
}

} // namespace

ConstraintTable readConstraintFile(const std::string& path, int wrap)
{
  ConstraintTable table = readAnyKind(path);
  if (table.Edges.empty() && table.Holes.empty())
  {
    refuseWithoutLines(path);
  }
  wrapLongitudes(path, wrap, table.XY);
  wrapLongitudes(path, wrap, table.Holes);
  return table;
}

} // namespace tipp
