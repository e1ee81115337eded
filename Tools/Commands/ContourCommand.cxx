// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/QueryMesh.h"
#include "Commands/Report.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/PendingOutput.h"
#include "Gis/GisFiles.h"
#include "Partitioned/PartitionedMesh.h"
#include "Query/Queries.h"
#include "Query/WriteLines.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(MESH    a partitioned mesh of triangles, which is read piece by piece; or any VTK file of
        triangles, or of other cells, which are cut into triangles.
LINES   .gpkg: a GeoPackage, which needs GDAL; or .vtp. Each line stores its level, and its
        points have the z of the surface.

Lines continue from piece to piece; they do not depend on pieces, threads and ranks. The
higher side is on the left. Under mpirun the ranks share the pieces of a partitioned
mesh. --memory is the limit of each rank, in bytes or such as 512M (2^20 bytes) or 2G.

Examples:
  tipp contour terrain.tipp -o contours.gpkg --interval 5 --crs EPSG:25832
  tipp contour surge.vtu -o level.vtp --array zeta --levels 0.5,1,2
)";

struct ContourArguments
{
  QueryMeshArguments Mesh;
  std::string Output;
  std::string Array = "elevation";
  int Component = 0;
  std::vector<double> Levels;
  double Interval = 0;
  std::string Crs;
};

/// Returns the multiples of the interval within the array's range. Collective.
std::vector<double> levelsOf(
  Communicator& ranks, const ResidentMesh& mesh, const ContourArguments& arguments)
{
  const auto [low, high] = rangeOf(mesh, arguments.Array, arguments.Component, &ranks);
  constexpr double most = 1e6;
  if ((high - low) / arguments.Interval > most)
  {
    throw IOError(
      fmt::format("An interval of {} would give more than 1000000 levels; give a larger one.",
        arguments.Interval));
  }
  // Beyond 2^53, doubles do not hold all multiples.
  const double largest = std::max(std::fabs(low), std::fabs(high));
  if (largest / arguments.Interval > 0x1p53 && low <= high)
  {
    throw IOError(
      fmt::format("An interval of {} is too small for values up to {}; give a larger one.",
        arguments.Interval, largest));
  }
  std::vector<double> levels;
  for (double i = std::ceil(low / arguments.Interval); i * arguments.Interval <= high; ++i)
  {
    levels.push_back(i * arguments.Interval);
  }
  return levels;
}

void writeLines(
  const ContourArguments& arguments, const Contours& contours, const PathState& before)
{
  if (isOpenedBy(arguments.Output, Opener::Gdal))
  {
    writeGeoPackage(arguments.Output, contours, arguments.Array, arguments.Crs, before);
    return;
  }
  writeContours(arguments.Output, before, contours, arguments.Array);
}

/// Makes the contour lines of all pieces, which the ranks share. The first rank writes the file.
/// Collective.
void makeContours(const ContourArguments& arguments, Communicator& ranks)
{
  PathState before;
  if (ranks.isFirst())
  {
    before = requireWritable(arguments.Output, "", { arguments.Mesh.Path });
  }
  // Only the first rank reads a mesh that is not partitioned.
  std::unique_ptr<ResidentMesh> mesh = ranks.isFirst() || isPartitionedMesh(arguments.Mesh.Path)
    ? openQueryMesh(arguments.Mesh)
    : std::make_unique<ResidentMesh>(MeshPart());
  if (ranks.isFirst())
  {
    noteStep(arguments.Mesh, *mesh);
  }
  const std::vector<double> levels =
    arguments.Interval > 0 ? levelsOf(ranks, *mesh, arguments) : arguments.Levels;
  const Contours contours = contoursOf(*mesh, arguments.Array, arguments.Component, levels, &ranks);
  mesh.reset(); // its memory is free for the file's
  if (ranks.isFirst())
  {
    writeLines(arguments, contours, before);
    fmt::print("{} lines of {} points, in {}\n", contours.Levels.size(), contours.Points.size(),
      arguments.Output);
  }
}

void addOptions(CLI::App& command, ContourArguments& arguments)
{
  command.add_option("mesh", arguments.Mesh.Path, "The mesh, see below")->required();
  addOutput(command, arguments.Output, "The file to write, see below", Use::WritesLines);
  command.add_option("--array", arguments.Array, "The name of a point array, or elevation for z")
    ->capture_default_str();
  addChecked(command, "--component", arguments.Component, CLI::Range(0, 1000000),
    "The component of an array that has several, counted from 0");
  CLI::Option_group* const levels = command.add_option_group("levels");
  levels->add_option("--levels", arguments.Levels, "The values of the lines, separated by commas")
    ->delimiter(',');
  levels->add_option("--interval", arguments.Interval, "Lines at all multiples of this value")
    ->check(checkPositive);
  levels->require_option(1);
  command.add_option("--crs", arguments.Crs, "The reference system of a .gpkg, such as EPSG:25832");
  addQueryMeshOptions(command, arguments.Mesh);
}

} // namespace

void addContourCommand(CLI::App& app, int& exitCode)
{
  addCommand<ContourArguments>(app, exitCode, "contour",
    "Makes lines of equal values on a mesh of triangles", footer, addOptions,
    [](ContourArguments& arguments)
    { return runOnRanks([&](Communicator& ranks) { makeContours(arguments, ranks); }); });
}

} // namespace tipp
