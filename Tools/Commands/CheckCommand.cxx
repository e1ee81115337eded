// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Check/DelaunayChecker.h"
#include "Commands/CheckPartitioned.h"
#include "Commands/PointArguments.h"
#include "Console/MpiSession.h"
#include "Files/IOError.h"
#include "Meshes/ReadMesh.h"
#include "Partitioned/PartitionedMesh.h"
#include "Points/ReadPoints.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(Exact, and without a triangulation of its own: every edge in at most two
triangles, all triangles counter-clockwise, every interior edge locally
Delaunay, the boundary one convex chain, the number of triangles Euler's, every
distinct point a vertex. Where the mesh has the cell array NeighborIds, the two
triangles of every edge name each other. A partitioned mesh is read piece by
piece and may be larger than memory. Exit code 0: no fault, 1: faults or a file that cannot
be read, 2: wrong usage.

Examples:
  tipp check points.npy triangles.npy
  tipp check survey.csv --x easting --y northing mesh.vtp --tie-rule
  tipp check fort.14 fort.14 --boundary-free
  tipp check points.npy mesh.tipp
)";

struct CheckArguments
{
  std::string Points;
  std::string Mesh;
  PointOptions Columns;
  CheckOptions Options;
};

// NaN equals nothing, but stands for itself here.
bool isSame(double a, double b)
{
  return a == b || (a != a && b != b);
}

// A mesh that brings its own points must bring these.
void requireSamePoints(
  const CheckArguments& arguments, const std::vector<double>& xy, const std::vector<double>& own)
{
  if (!own.empty() && !std::equal(xy.begin(), xy.end(), own.begin(), own.end(), isSame))
  {
    throw IOError(arguments.Mesh,
      fmt::format("its {} points are not the {} points of {}; check it against the points that it "
                  "was made from.",
        own.size() / 2, xy.size() / 2, arguments.Points));
  }
}

CheckReport check(const CheckArguments& arguments)
{
  std::error_code ignored;
  // No other kind of mesh is a folder here; one without its index is named as such.
  if (isPartitionedMesh(arguments.Mesh) || std::filesystem::is_directory(arguments.Mesh, ignored))
  {
    return checkPartitioned(arguments.Points, arguments.Columns, arguments.Mesh, arguments.Options);
  }
  const PointTable points = readPoints(arguments.Points, arguments.Columns);
  TriangleMesh mesh = readMesh(arguments.Mesh);
  requireSamePoints(arguments, points.XY, mesh.XY);
  mesh.XY = {};
  return checkDelaunay(points.XY, mesh.Triangles, arguments.Options, mesh.Neighbors);
}

int runCheck(const CheckArguments& arguments)
{
  const CheckReport report = check(arguments);
  fmt::print("{} points ({} distinct), {} triangles, {} boundary edges, {} co-circular ties: {}\n",
    report.Points, report.DistinctPoints, report.Triangles, report.BoundaryEdges, report.Ties,
    report.isCorrect() ? "correct" : "FAULTY");
  for (const std::string& fault : report.faults())
  {
    fmt::print("  {}\n", fault);
  }
  return report.isCorrect() ? Success : Failure;
}

} // namespace

void addCheckCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* const command = app.add_subcommand(
    "check", "Checks that triangles are the Delaunay triangulation of points, exactly");
  command->add_option("points", arguments->Points, "The points, in any format of 'tipp delaunay'")
    ->required();
  command
    ->add_option("mesh", arguments->Mesh,
      "The triangles: .npy (m x 3 integers), .14, .grd, a VTK file or a partitioned mesh")
    ->required();
  addPointOptions(*command, arguments->Columns);
  command->add_flag("--tie-rule", arguments->Options.TieRule,
    "Also check that ties between co-circular points are broken by the lexicographic order of the "
    "points, which makes the triangulation unique");
  command->add_flag("--boundary-free", arguments->Options.BoundaryFree,
    "The mesh has a boundary of its own: do not check the hull and Euler's count");
  command->footer(footer);
  command->callback(
    [arguments, &exitCode]() { exitCode = isIdleRank() ? Success : runCheck(*arguments); });
}

} // namespace tipp
