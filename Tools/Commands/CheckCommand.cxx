// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/CheckRuns.h"

#include "Check/ConstraintChains.h"
#include "Commands/PointArguments.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Meshes/MeshFiles.h"
#include "Predicates/Points.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

namespace tipp
{

bool isStoredInPieces(const std::string& mesh)
{
  std::error_code ignored;
  return isPartitionedMesh(mesh) || std::filesystem::is_directory(mesh, ignored);
}

void refuseOtherPoints(const CheckArguments& arguments, std::size_t found, std::size_t points)
{
  throw IOError(arguments.Mesh,
    fmt::format("its {} points are not the {} points of {}; check it against the points that it "
                "was made from.",
      found, points, arguments.Points));
}

namespace
{

bool isSameNumber(double a, double b)
{
  return a == b || (a != a && b != b);
}

} // namespace

void requireSamePoints(const CheckArguments& arguments, const std::vector<double>& points,
  const std::vector<double>& stored, std::size_t dimension)
{
  if (!stored.empty() &&
    !std::equal(points.begin(), points.end(), stored.begin(), stored.end(), isSameNumber))
  {
    refuseOtherPoints(arguments, stored.size() / dimension, points.size() / dimension);
  }
}

namespace
{

constexpr const char* meshFormats =
  "The triangles: .npy (m x 3 integers), .14, .grd, a VTK file or a partitioned mesh; or "
  "tetrahedra: .npy (m x 4 integers), .vtu or a partitioned mesh";

constexpr const char* footer =
  R"(The check is exact and computes no triangulation of its own. It requires: every edge is in
at most two triangles, all triangles are counter-clockwise, every interior edge is locally
Delaunay, the boundary is one convex chain, the number of triangles follows Euler's formula,
and every distinct point is a vertex. If the mesh has the cell array NeighborIds, the two
triangles of every edge must store each other. A partitioned mesh is read piece by piece
and may be larger than memory. Exit codes: 0: no fault; 1: faults, or a file that cannot be
read; 2: wrong usage.

With --constraints, the constraints' edges need not be locally Delaunay, and the mesh may
have more points after the given ones. With --cut, or if the constraints have polygons or
holes, each boundary edge must be an edge of a constraint or of the convex hull, and
constraints may lie outside of the mesh. Whether the right triangles were removed is not
checked.

Tetrahedra are checked in the same way, in memory.

Examples:
  tipp check points.npy triangles.npy
  tipp check survey.csv --x easting --y northing mesh.vtp --tie-rule
  tipp check fort.14 fort.14 --boundary-free
  tipp check points.npy mesh.tipp
  tipp check survey.csv survey.vtp --constraints breaklines.vtp --tie-rule
  tipp check particles.npy tetrahedra.vtu --tie-rule
)";

/// Returns the constraints as indices of the mesh's points: the first one with equal coordinates,
/// or -1. Constraints whose ends are not finite are left out.
std::vector<std::array<std::int64_t, 2>> constraintsAmong(
  const std::vector<double>& xy, const ConstraintTable& table)
{
  if (table.XY.empty())
  {
    return table.Edges;
  }
  const auto pointAt = [](const std::vector<double>& from, std::int64_t i) {
    return std::array<double, 2>{ from[2 * std::size_t(i)], from[2 * std::size_t(i) + 1] };
  };
  const auto isGood = [](const std::array<double, 2>& p) { return isFinite({ p[0], p[1] }); };
  std::map<std::array<double, 2>, std::int64_t> indices; // NaN has no order
  for (std::int64_t i = 0; i < std::int64_t(xy.size() / 2); ++i)
  {
    const auto point = pointAt(xy, i);
    if (isGood(point))
    {
      indices.emplace(point, i);
    }
  }
  const auto indexOf = [&indices](const std::array<double, 2>& p)
  {
    const auto found = indices.find(p);
    return found == indices.end() ? -1 : found->second;
  };
  std::vector<std::array<std::int64_t, 2>> constraints;
  for (const auto& edge : table.Edges)
  {
    const auto first = pointAt(table.XY, edge[0]);
    const auto last = pointAt(table.XY, edge[1]);
    if (isGood(first) && isGood(last))
    {
      constraints.push_back({ indexOf(first), indexOf(last) });
    }
  }
  return constraints;
}

/// Checks a mesh with constraints, whose first points are the input points.
CheckReport checkConstrained(
  const CheckArguments& arguments, std::vector<double>& points, TriangleMesh& mesh)
{
  std::vector<double>& xy = mesh.XY.empty() ? points : mesh.XY;
  if (xy.size() < points.size() ||
    !std::equal(points.begin(), points.end(), xy.begin(), isSameNumber))
  {
    throw IOError(arguments.Mesh,
      fmt::format("its first {} points are not those of {}; check it against the points that it "
                  "was made from.",
        points.size() / 2, arguments.Points));
  }
  const ConstraintTable table = readConstraintFile(arguments.Constraints);
  std::vector<std::array<std::int64_t, 2>> constraints = constraintsAmong(xy, table);
  const std::int64_t count = std::int64_t(xy.size() / 2);
  const auto lost = std::remove_if(constraints.begin(), constraints.end(),
    [count](const auto& ids)
    { return std::min(ids[0], ids[1]) < 0 || std::max(ids[0], ids[1]) >= count; });
  const std::int64_t missing = constraints.end() - lost;
  constraints.erase(lost, constraints.end());
  CheckOptions options = arguments.Options;
  options.IsCut = arguments.isCutBy(table);
  ConstraintChains chains = findConstraintChains(xy, mesh.Triangles, constraints, options.IsCut);
  options.Constraints = std::move(chains.Edges);
  CheckReport report =
    checkDelaunay(std::move(xy), std::move(mesh.Triangles), options, std::move(mesh.Neighbors));
  report.LostConstraints = chains.Lost + missing;
  return report;
}

CheckReport checkTriangles(const CheckArguments& arguments)
{
  std::vector<double> xy = readPoints(arguments.Points, arguments.Columns).XY;
  TriangleMesh mesh = readMesh(arguments.Mesh);
  if (!arguments.Constraints.empty())
  {
    return checkConstrained(arguments, xy, mesh);
  }
  requireSamePoints(arguments, xy, mesh.XY, 2);
  mesh.XY = {};
  return checkDelaunay(
    std::move(xy), std::move(mesh.Triangles), arguments.Options, std::move(mesh.Neighbors));
}

int runCheck(const CheckArguments& arguments)
{
  const bool isPartitioned = isStoredInPieces(arguments.Mesh);
  if (isPartitioned ? openPartitionedMesh(arguments.Mesh).CellSize == 4
                    : holdsTetrahedra(arguments.Mesh))
  {
    return checkTetrahedra(arguments);
  }
  const CheckReport report =
    isPartitioned ? checkPartitioned(arguments) : checkTriangles(arguments);
  fmt::print("{} points ({} distinct), {} triangles, {} boundary edges, {} co-circular ties: ",
    report.Points, report.DistinctPoints, report.Triangles, report.BoundaryEdges, report.Ties);
  return printFaults(report);
}

} // namespace

void addCheckCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* const command = app.add_subcommand(
    "check", "Checks that triangles are the Delaunay triangulation of points, exactly");
  command->add_option("points", arguments->Points, "The points, in any format of 'tipp delaunay'")
    ->required();
  command->add_option("mesh", arguments->Mesh, meshFormats)->required();
  addPointOptions(*command, arguments->Columns);
  command->add_flag("--tie-rule", arguments->Options.TieRule,
    "Also check that ties between co-circular points are broken by the points' lexicographic "
    "order, which makes the triangulation unique");
  command->add_flag("--boundary-free", arguments->Options.BoundaryFree,
    "The mesh need not fill the convex hull: do not check its boundary and Euler's formula");
  command->add_option("--constraints", arguments->Constraints,
    "The file of constraints that 'tipp delaunay' used; the mesh may have more points after the "
    "given ones");
  command->add_flag("--cut", arguments->Options.IsCut,
    "With --constraints: the mesh lacks triangles outside of polygons or in holes");
  command->footer(footer);
  command->callback(
    [arguments, &exitCode]() { exitCode = isIdleRank() ? Success : runCheck(*arguments); });
}

} // namespace tipp
