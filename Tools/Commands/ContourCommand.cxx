// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/QueryMesh.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputPath.h"
#include "Files/PendingOutput.h"
#include "Parallel/Poll.h"
#include "Query/LineData.h"
#include "Query/Lines.h"
#include "Query/WriteLines.h"
#include "Vtk/WriteXmlFile.h"

#include "vtkXMLPolyDataWriter.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

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
        triangles or cells that are cut into them.
LINES   .gpkg, a GeoPackage, by GDAL; or .vtp. Each line has its level, and its points
        have the z of the surface.

A line goes on across pieces; lines are the same for any pieces and threads. The higher
side is on the left. Memory is in bytes, or with K, M, G for 2^10, 2^20, 2^30 of them.

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

/// The multiples of the interval in the array's range.
std::vector<double> levelsOf(const ResidentMesh& mesh, const ContourArguments& arguments)
{
  const auto [low, high] = rangeOf(mesh, arguments.Array, arguments.Component);
  constexpr double most = 1e6;
  if ((high - low) / arguments.Interval > most)
  {
    throw IOError("An interval of " + fmt::format("{}", arguments.Interval) +
      " would give more than 1000000 levels; give a larger one.");
  }
  std::vector<double> levels;
  for (double i = std::ceil(low / arguments.Interval); i * arguments.Interval <= high; ++i)
  {
    levels.push_back(i * arguments.Interval);
  }
  return levels;
}

int runContour(const ContourArguments& arguments)
{
  requireApart({ arguments.Output }, { arguments.Mesh.Path });
  const PathState before = PendingFile(arguments.Output).before(); // fails early
  const PollScope scope([] { return !isInterrupted(); });
  try
  {
    const auto mesh = openQueryMesh(arguments.Mesh);
    const Contours contours = contoursOf(*mesh, arguments.Array, arguments.Component,
      arguments.Interval > 0 ? levelsOf(*mesh, arguments) : arguments.Levels);
    if (extensionOf(arguments.Output) == ".gpkg")
    {
      writeGeoPackage(arguments.Output, contours, arguments.Array, arguments.Crs, before);
    }
    else
    {
      PendingFile pending(arguments.Output, before);
      writeXmlFile<vtkXMLPolyDataWriter>(
        arguments.Output, pending, polyDataOf(contours, arguments.Array));
      pending.commit();
    }
    fmt::print("{} lines of {} points, in {}\n", contours.Levels.size(), contours.Points.size(),
      arguments.Output);
  }
  catch (const WorkAborted&)
  {
    return reportInterrupt();
  }
  return Success;
}

} // namespace

void addContourCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<ContourArguments>();
  CLI::App* const command =
    app.add_subcommand("contour", "Makes lines of equal values on a mesh of triangles");
  command->add_option("mesh", arguments->Mesh.Path, "The mesh, see below")->required();
  command->add_option("-o,--output", arguments->Output, "The file to write, see below")
    ->required()
    ->check(
      [](const std::string& path)
      {
        const std::string extension = extensionOf(path);
        return extension == ".gpkg" || extension == ".vtp"
          ? ""
          : "'" + path + "' does not end in .gpkg or .vtp";
      });
  command->add_option("--array", arguments->Array, "An array of the points, or elevation")
    ->capture_default_str();
  command->add_option("--component", arguments->Component, "Of an array that has several")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  CLI::Option_group* const levels = command->add_option_group("levels");
  levels->add_option("--levels", arguments->Levels, "The values")->delimiter(',');
  levels->add_option("--interval", arguments->Interval, "All multiples of this")
    ->check(CLI::PositiveNumber);
  levels->require_option(1);
  command->add_option("--crs", arguments->Crs, "Of a .gpkg the reference system, as EPSG:25832");
  addQueryMeshOptions(*command, arguments->Mesh);
  command->footer(footer);
  command->callback(
    [arguments, &exitCode]() { exitCode = isIdleRank() ? Success : runContour(*arguments); });
}

} // namespace tipp
