// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayConstraints.h"

#include "Constraints/KeepInside.h"
#include "Constraints/MatchPositions.h"
#include "Constraints/ReadConstraintFile.h"
#include "Constraints/TriangulateConstrained.h"
#include "Files/Extension.h"
#include "Files/IOError.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace tipp
{
namespace
{

PointsView viewOf(const std::vector<double>& xy)
{
  return PointsView(xy.data(), xy.size() / 2, 2);
}

/// Returns the table's edges as constraints between the points; points of the table that are not
/// among `points` are appended to them.
std::vector<Constraint> joinTable(const ConstraintTable& table, PointTable& points)
{
  std::vector<Constraint> constraints;
  if (table.XY.empty())
  {
    for (const auto& edge : table.Edges)
    {
      constraints.push_back({ edge[0], edge[1] });
    }
    return constraints;
  }
  const MatchedPositions matched = matchPositions(viewOf(points.XY), viewOf(table.XY));
  for (const std::size_t own : matched.New)
  {
    points.XY.push_back(table.XY[2 * own]);
    points.XY.push_back(table.XY[2 * own + 1]);
    for (PointTable::Column& column : points.Columns)
    {
      const bool isHeight = column.Name == "z" && !table.Height.empty();
      column.Values.push_back(isHeight ? table.Height[own] : std::nan(""));
    }
  }
  for (const auto& edge : table.Edges)
  {
    constraints.push_back({ matched.Ids[std::size_t(edge[0])], matched.Ids[std::size_t(edge[1])] });
  }
  return constraints;
}

void appendCrossings(const std::vector<CrossingPoint>& crossings, PointTable& points)
{
  for (const CrossingPoint& crossing : crossings)
  {
    points.XY.push_back(crossing.Position.x);
    points.XY.push_back(crossing.Position.y);
    for (PointTable::Column& column : points.Columns)
    {
      const double a = column.Values[std::size_t(crossing.A)];
      const double b = column.Values[std::size_t(crossing.B)];
      column.Values.push_back((1 - crossing.Fraction) * a + crossing.Fraction * b);
    }
  }
}

/// Fails if an edge of a polygon is missing, because then its inside is undefined.
void cutOutside(
  const ConstraintTable& table, const PointTable& points, ConstrainedTriangulation& result)
{
  const std::vector<ConstraintPiece>& pieces = result.Constraints.Pieces;
  std::vector<ConstraintPiece> polygonEdges;
  for (const ConstraintPiece& piece : pieces)
  {
    if (std::size_t(piece.Constraint) >= table.PolygonBegin)
    {
      polygonEdges.push_back(piece);
    }
  }
  if (!polygonEdges.empty() && result.Constraints.NotFinite > 0)
  {
    throw std::invalid_argument(
      "it has polygons, and a point that is NaN or infinite; correct the point.");
  }
  std::vector<Point2> holes;
  for (std::size_t i = 0; i < table.Holes.size(); i += 2)
  {
    holes.push_back({ table.Holes[i], table.Holes[i + 1] });
  }
  if (!holes.empty())
  {
    removeHoles(viewOf(points.XY), result.Mesh, pieces, holes);
  }
  if (!polygonEdges.empty() && result.Mesh.triangleCount() > 0)
  {
    keepInside(result.Mesh, polygonEdges);
  }
}

std::string describe(const ResolvedConstraints& resolved, std::size_t constraints)
{
  std::string text = fmt::format("{} constraints of {} edges, {} crossings", constraints,
    resolved.Pieces.size(), resolved.Crossings.size());
  if (resolved.NotFinite > 0)
  {
    text += fmt::format(", {} left out, since an end is not finite", resolved.NotFinite);
  }
  return text;
}

} // namespace

Triangulation triangulateWithConstraints(const DelaunayArguments& arguments, PointTable& points,
  const TriangulationOptions& options, std::string& report)
{
  ConstraintTable table = readConstraintFile(arguments.Constraints);
  for (const auto& [x, y] : arguments.Holes)
  {
    table.Holes.insert(table.Holes.end(), { x, y });
  }
  const std::size_t given = points.size();
  const std::vector<Constraint> constraints = joinTable(table, points);
  try
  {
    ConstrainedTriangulation result = triangulateConstrained(viewOf(points.XY), constraints,
      arguments.RefuseCrossings ? CrossingRule::Refuse : CrossingRule::Split, options);
    if (result.Mesh.Aborted)
    {
      return std::move(result.Mesh);
    }
    appendCrossings(result.Constraints.Crossings, points);
    if (points.size() > given && extensionOf(arguments.Output) == ".npy")
    {
      throw std::invalid_argument(
        fmt::format("it adds {} points to those of {}, which an output named .npy does not hold; "
                    "name it .vtp or .vtu.",
          points.size() - given, arguments.Input));
    }
    cutOutside(table, points, result);
    report = describe(result.Constraints, constraints.size());
    return std::move(result.Mesh);
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(arguments.Constraints, error.what());
  }
}

} // namespace tipp
