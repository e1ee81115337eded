// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/TableConstraints.h"

#include "Constraints/ConstraintPoints.h"
#include "Constraints/KeepInside.h"
#include "Files/IOError.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

PointsView viewOf(const std::vector<double>& xy)
{
  return PointsView(xy.data(), xy.size() / 2, 2);
}

/// Appends the table's points, except those that exist already, and its edges.
void join(const ConstraintTable& table, PointTable& points, std::vector<Constraint>& constraints)
{
  if (table.XY.empty()) // its edges refer to the points
  {
    for (const auto& edge : table.Edges)
    {
      constraints.push_back({ edge[0], edge[1] });
    }
    return;
  }
  const MatchedPositions matched = matchPositions(viewOf(points.XY), viewOf(table.XY));
  for (const std::size_t own : matched.New)
  {
    points.XY.push_back(table.XY[2 * own]);
    points.XY.push_back(table.XY[2 * own + 1]);
    for (PointTable::Column& column : points.Columns)
    {
      column.Values.push_back(
        isHeightColumn(column.Name) && !table.Height.empty() ? table.Height[own] : std::nan(""));
    }
  }
  for (const auto& edge : table.Edges)
  {
    constraints.push_back({ matched.Ids[std::size_t(edge[0])], matched.Ids[std::size_t(edge[1])] });
  }
}

/// Sets the NaN values of points from index `given` on, by interpolation on the surface of the
/// points before.
void takeSurface(
  std::size_t given, DuplicateRule rule, const TriangulationOptions& options, PointTable& points)
{
  const auto isMissing = [given](const PointTable::Column& column)
  {
    return std::any_of(column.Values.begin() + std::ptrdiff_t(given), column.Values.end(),
      [](double value) { return std::isnan(value); });
  };
  if (std::none_of(points.Columns.begin(), points.Columns.end(), isMissing))
  {
    return;
  }
  TriangulationOptions plain;
  plain.Threads = options.Threads;
  const PointsView before(points.XY.data(), given, 2);
  const Triangulation surface = triangulate(before, plain);
  PointTable resolved;
  if (rule != DuplicateRule::First)
  {
    resolved.Columns = points.Columns;
    resolveDuplicates(resolved, surface.Duplicates, rule);
  }
  std::vector<const double*> columns;
  for (const PointTable::Column& column :
    rule == DuplicateRule::First ? points.Columns : resolved.Columns)
  {
    columns.push_back(column.Values.data());
  }
  std::vector<Point2> positions;
  viewOf(points.XY).forEach(
    given, points.size(), [&](std::size_t, Point2 position) { positions.push_back(position); });
  const auto values = valuesOnSurface(positions, before, surface, columns, options.Threads);
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      double& value = points.Columns[c].Values[given + i];
      value = std::isnan(value) ? values[c][i] : value;
    }
  }
}

void appendCrossings(const std::vector<CrossingPoint>& crossings, PointTable& points)
{
  const std::size_t given = points.size();
  for (const CrossingPoint& crossing : crossings)
  {
    points.XY.push_back(crossing.Position.x);
    points.XY.push_back(crossing.Position.y);
  }
  for (PointTable::Column& column : points.Columns)
  {
    column.Values.resize(given + crossings.size());
    interpolateTuples(crossings, given, Scalar::Float64, 1, column.Values.data());
  }
}

void cutOutside(
  const TableConstraints& constraints, const PointTable& points, ConstrainedTriangulation& result)
{
  const std::vector<ConstraintPiece>& pieces = result.Constraints.Pieces;
  const std::size_t lines = constraints.Lines.Edges.size();
  const Cuts cuts{ piecesOf(pieces, constraints.Lines.PolygonBegin, lines),
    piecesOf(pieces, lines, lines + constraints.Boundary.Edges.size()), constraints.Lines.holes() };
  // A polygon with a missing edge has no inside.
  if (!(cuts.Polygons.empty() && cuts.Boundary.empty()) && result.Constraints.NotFinite > 0)
  {
    throw std::invalid_argument(
      "it has polygons, and a point that is NaN or infinite; correct the point.");
  }
  keepInside(viewOf(points.XY), result.Mesh, pieces, cuts);
}

} // namespace

bool isHeightColumn(const std::string& name)
{
  return name == "z" || name == "Z" || name == "elevation";
}

ConstrainedTriangulation triangulateTable(
  PointTable& points, const TableConstraints& constraints, const TriangulationOptions& options)
{
  const std::size_t given = points.size();
  std::vector<Constraint> all;
  join(constraints.Lines, points, all);
  join(constraints.Boundary, points, all);
  if (constraints.Surface)
  {
    takeSurface(given, *constraints.Surface, options, points);
  }
  const auto cut = [&](ConstrainedTriangulation& whole)
  {
    appendCrossings(whole.Constraints.Crossings, points);
    cutOutside(constraints, points, whole);
  };
  return triangulateConstrained(viewOf(points.XY), all, constraints.Crossings, options, cut);
}

TableConstraints readConstraints(const ConstraintFiles& files)
{
  TableConstraints constraints;
  if (!files.Lines.empty())
  {
    constraints.Lines = readConstraintFile(files.Lines);
  }
  for (const auto& [x, y] : files.Holes)
  {
    constraints.Lines.Holes.insert(constraints.Lines.Holes.end(), { x, y });
  }
  if (!files.Boundary.empty())
  {
    constraints.Boundary = readBoundary(files.Boundary);
  }
  constraints.Crossings = files.Crossings;
  return constraints;
}

ConstraintTable readBoundary(const std::string& path)
{
  ConstraintTable boundary = readConstraintFile(path);
  try
  {
    requireClosedBoundary(boundary);
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(path, error.what());
  }
  return boundary;
}

void requireClosedBoundary(const ConstraintTable& boundary)
{
  if (boundary.Edges.empty() || boundary.XY.empty())
  {
    throw std::invalid_argument(
      "it has no lines with coordinates, so it is no boundary; give closed lines or polygons.");
  }
  std::map<std::pair<double, double>, int> ends; // number of edges; odd ends are open
  for (const auto& edge : boundary.Edges)
  {
    for (const std::int64_t end : edge)
    {
      const auto at = 2 * std::size_t(end);
      ++ends[{ boundary.XY[at], boundary.XY[at + 1] }];
    }
  }
  const auto open =
    std::find_if(ends.begin(), ends.end(), [](const auto& end) { return end.second % 2 != 0; });
  if (open != ends.end())
  {
    std::ostringstream text;
    text << "the boundary is not closed: a line ends at (" << open->first.first << ", "
         << open->first.second << "); close it there.";
    throw std::invalid_argument(text.str());
  }
}

} // namespace tipp
