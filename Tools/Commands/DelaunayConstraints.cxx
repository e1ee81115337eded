// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayConstraints.h"

#include "Constraints/ReadConstraintFile.h"
#include "Constraints/TableConstraints.h"
#include "Files/Extension.h"
#include "Files/IOError.h"

#include <fmt/format.h>

#include <stdexcept>

namespace tipp
{
namespace
{

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

Triangulation triangulateWithConstraints(const DelaunayArguments& arguments, PointTable& points,
  const TriangulationOptions& options, std::string& report)
{
  TableConstraints constraints;
  if (!arguments.Constraints.empty())
  {
    constraints.Lines = readConstraintFile(arguments.Constraints);
  }
  for (const auto& [x, y] : arguments.Holes)
  {
    constraints.Lines.Holes.insert(constraints.Lines.Holes.end(), { x, y });
  }
  if (!arguments.Boundary.empty())
  {
    constraints.Boundary = readBoundary(arguments.Boundary);
  }
  constraints.Crossings = arguments.RefuseCrossings ? CrossingRule::Refuse : CrossingRule::Split;
  const std::size_t given = points.size();
  try
  {
    ConstrainedTriangulation result = triangulateTable(points, constraints, options);
    if (result.Mesh.Aborted)
    {
      return std::move(result.Mesh);
    }
    if (points.size() > given && extensionOf(arguments.Output) == ".npy")
    {
      throw std::invalid_argument(
        fmt::format("it adds {} points to those of {}, which an output named .npy does not hold; "
                    "name it .vtp or .vtu.",
          points.size() - given, arguments.Input));
    }
    report = describe(
      result.Constraints, constraints.Lines.Edges.size() + constraints.Boundary.Edges.size());
    return std::move(result.Mesh);
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(
      arguments.Constraints.empty() ? arguments.Boundary : arguments.Constraints, error.what());
  }
}

} // namespace tipp
