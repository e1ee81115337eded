// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Commands/DelaunayStatistics.h"
#include "Console/Interrupt.h"
#include "Console/ProgressBar.h"
#include "Files/Extension.h"
#include "Files/PendingFile.h"
#include "Meshes/WriteMesh.h"
#include "Points/ReadPoints.h"
#include "Triangulation/Triangulate.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(INPUT   .npy (n x 2 or n x 3, float64 or float32); .csv, .txt, .xyz (one point a
        line, columns parted by comma, semicolon, tab or blanks; a line of names
        or of the count is found); .14, .grd (ADCIRC); any VTK file.
OUTPUT  .vtp, .vtu (all points with their data, a column named z as third
        coordinate) or .npy (m x 3 int64: point ids, counted from 0,
        counter-clockwise).

Duplicates are merged, points that are not finite are left out. Ctrl-C ends the
run with exit code 130 and no output. Seconds in the summary are those of the
triangulation alone; memory is in millions of bytes.

Examples:
  tipp delaunay points.npy -o triangles.npy
  tipp delaunay survey.csv --x easting --y northing -o survey.vtp --threads 4
  tipp delaunay fort.14 -o mesh.vtu --partitions 8x8 --stats run.json
)";

struct DelaunayArguments
{
  std::string Input;
  std::string Output;
  PointOptions Columns;
  int Threads = 0;
  std::string Partitions = "auto";
  std::string Order = "dynamic";
  int InitialPoints = 0;
  bool MapDuplicates = false;
  std::string Statistics;
};

struct Grid
{
  int Columns = 0;
  int Rows = 0;
};

// "auto" is a grid of no columns and rows.
std::optional<Grid> parseGrid(const std::string& text)
{
  if (text == "auto")
  {
    return Grid{};
  }
  constexpr int limit = 10000;
  Grid grid;
  const char* const end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, grid.Columns);
  if (columns.ec != std::errc() || columns.ptr == end || *columns.ptr != 'x')
  {
    return std::nullopt;
  }
  const auto rows = std::from_chars(columns.ptr + 1, end, grid.Rows);
  const bool good = rows.ec == std::errc() && rows.ptr == end && grid.Columns >= 1 &&
    grid.Columns <= limit && grid.Rows >= 1 && grid.Rows <= limit;
  return good ? std::make_optional(grid) : std::nullopt;
}

class Stopwatch
{
public:
  /// Since the last call.
  double seconds()
  {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - this->Start;
    this->Start = now;
    return passed.count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

TriangulationOptions makeOptions(const DelaunayArguments& arguments, ProgressBar& bar)
{
  const Grid grid = *parseGrid(arguments.Partitions);
  TriangulationOptions options;
  options.Columns = grid.Columns;
  options.Rows = grid.Rows;
  options.InitialPointsPerPartition = arguments.InitialPoints;
  options.Order = arguments.Order == "stages" ? Schedule::Stages : Schedule::Dynamic;
  options.Threads = arguments.Threads;
  options.Progress = [&bar](double fraction)
  {
    bar.update(fraction);
    return !isInterrupted();
  };
  return options;
}

Triangulation triangulatePoints(const DelaunayArguments& arguments, const PointTable& points)
{
  ProgressBar bar("Triangulating");
  return triangulate(PointsView(points.XY.data(), points.size(), 2), makeOptions(arguments, bar));
}

TrianglesView viewOf(const Triangulation& result)
{
  return result.Ids64.empty() ? TrianglesView(result.Ids32.data(), result.triangleCount())
                              : TrianglesView(result.Ids64.data(), result.triangleCount());
}

std::vector<std::int64_t> representatives(const Triangulation& result, std::size_t points)
{
  std::vector<std::int64_t> ids(points);
  std::iota(ids.begin(), ids.end(), std::int64_t(0));
  for (const Duplicate& duplicate : result.Duplicates)
  {
    ids[std::size_t(duplicate.Point)] = duplicate.Representative;
  }
  for (const PointId rejected : result.Rejected)
  {
    ids[std::size_t(rejected)] = -1;
  }
  return ids;
}

bool writeResult(
  const DelaunayArguments& arguments, const PointTable& points, const Triangulation& result)
{
  MeshOptions options;
  options.Aborted = isInterrupted;
  if (arguments.MapDuplicates)
  {
    options.Representatives = representatives(result, points.size());
  }
  return writeMesh(arguments.Output, points, viewOf(result), options);
}

// Before hours of work rather than after them.
void requireWritable(const DelaunayArguments& arguments)
{
  const PendingFile output(arguments.Output);
  if (!arguments.Statistics.empty())
  {
    const PendingFile statistics(arguments.Statistics);
  }
}

int reportInterrupt()
{
  fmt::print(stderr, "tipp: interrupted; nothing was written.\n");
  return interruptedExitCode;
}

int runDelaunay(const DelaunayArguments& arguments)
{
  watchForInterrupt();
  requireWritable(arguments);
  DelaunayRun run;
  run.Input = arguments.Input;
  run.Output = arguments.Output;
  Stopwatch watch;
  PointTable points = readPoints(arguments.Input, arguments.Columns);
  if (extensionOf(arguments.Output) == ".npy")
  {
    points.Columns.clear(); // only .vtp and .vtu keep them
  }
  run.Points = std::int64_t(points.size());
  run.ReadSeconds = watch.seconds();
  if (isInterrupted())
  {
    return reportInterrupt();
  }
  const Triangulation result = triangulatePoints(arguments, points);
  run.TriangulateSeconds = watch.seconds();
  if (result.Aborted || isInterrupted() || !writeResult(arguments, points, result))
  {
    return reportInterrupt();
  }
  run.WriteSeconds = watch.seconds();
  if (!arguments.Statistics.empty())
  {
    writeStatistics(arguments.Statistics, run, result);
  }
  fmt::print("{}\n", summarize(run, result));
  if (result.triangleCount() == 0)
  {
    fmt::print(stderr,
      "tipp: warning: no triangles, since there are fewer than three distinct points or all lie on "
      "one line.\n");
  }
  return Success;
}

std::string checkOutput(const std::string& path)
{
  return isMeshFile(path) ? "" : "'" + path + "' does not end in .vtp, .vtu or .npy";
}

std::string checkPartitions(const std::string& text)
{
  return parseGrid(text)
    ? ""
    : "'" + text + "' is neither auto nor COLUMNSxROWS of 1 to 10000 each, as 8x8";
}

void addTuning(CLI::App& command, DelaunayArguments& arguments)
{
  command.add_option("--threads", arguments.Threads, "Number of threads; 0: OpenMP's choice")
    ->check(CLI::Range(0, 4096))
    ->capture_default_str();
  command
    .add_option("--partitions", arguments.Partitions,
      "Columns and rows of partitions, as 8x8, or auto: chosen for the points")
    ->check(checkPartitions)
    ->capture_default_str();
  command
    .add_option("--schedule", arguments.Order,
      "stages: independent partitions together, then the next; dynamic: each as soon as it can")
    ->check(CLI::IsMember({ "stages", "dynamic" }))
    ->capture_default_str();
  command
    .add_option("--initial-points", arguments.InitialPoints,
      "Points of each partition in the initial mesh; 0: chosen")
    ->check(CLI::Range(0, 1000000))
    ->capture_default_str();
}

} // namespace

void addDelaunayCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<DelaunayArguments>();
  CLI::App* const command =
    app.add_subcommand("delaunay", "Triangulates points: exact 2D Delaunay, in parallel");
  command->add_option("input", arguments->Input, "The points")->required();
  command->add_option("-o,--output", arguments->Output, "The triangles")
    ->required()
    ->check(checkOutput);
  command->add_option("--x", arguments->Columns.X, "Column of x: a name, or a number from 0");
  command->add_option("--y", arguments->Columns.Y, "Column of y: a name, or a number from 0");
  addTuning(*command, *arguments);
  command->add_flag("--map-duplicates", arguments->MapDuplicates,
    "Add the point array RepresentativePointId to .vtp or .vtu: the id of the vertex that stands "
    "for a "
    "point, -1 for points that are not finite");
  command->add_option("--stats", arguments->Statistics, "A JSON file for figures of the run");
  command->footer(footer);
  command->callback(
    [arguments, &exitCode]()
    {
      if (arguments->MapDuplicates && extensionOf(arguments->Output) == ".npy")
      {
        throw CLI::ValidationError(
          "--map-duplicates", "needs an output of points, so .vtp or .vtu");
      }
      exitCode = runDelaunay(*arguments);
    });
}

} // namespace tipp
