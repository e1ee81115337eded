// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/TriangulateTable.h"

#include "Constraints/PositionIndex.h"
#include "Constraints/SurfaceValues.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

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
void takeSurface(std::size_t given, DuplicateRule rule, int threads, PointTable& points)
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
  plain.Threads = threads;
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
  const auto values = valuesOnSurface(positions, before, surface, columns, threads);
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

} // namespace

SourceConstraints joinTable(PointTable& points, const TableConstraints& constraints, int threads)
{
  const std::size_t given = points.size();
  SourceConstraints joined;
  join(constraints.Lines, points, joined.Constraints);
  join(constraints.Boundary, points, joined.Constraints);
  joined.PolygonBegin = constraints.Lines.PolygonBegin;
  joined.BoundaryEdges = constraints.Boundary.Edges.size();
  joined.Holes = constraints.Lines.holes();
  if (constraints.Surface)
  {
    takeSurface(given, *constraints.Surface, threads, points);
  }
  return joined;
}

ConstrainedTriangulation triangulateTable(
  PointTable& points, const TableConstraints& constraints, const TriangulationOptions& options)
{
  const SourceConstraints joined = joinTable(points, constraints, options.Threads);
  std::vector<std::string> warnings; // are those of other callers
  ConstrainedTriangulation result =
    triangulatePoints(viewOf(points.XY), { options, 0, &joined, constraints.Crossings }, warnings);
  if (!result.Mesh.Aborted)
  {
    appendCrossings(result.Constraints.Crossings, points);
  }
  return result;
}

} // namespace tipp
