// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Commands/DelaunayRuns.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/InputFile.h"
#include "Meshes/MeshFiles.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/Triangulate.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(INPUT   - for text from standard input; .npy (n x 2 or n x 3, float64 or float32); .csv, .txt, .xyz (one point a
        line, columns parted by comma, semicolon, tab or blanks; a line of names
        or of the count is found); .las (1.0 to 1.4), .laz with LASzip; .14, .grd
        (ADCIRC); any VTK file. Several files are one set of points, if they have the
        same columns. With a .tipp output also uniform:COUNT: COUNT uniform points
        are uniform in the unit square. Of LAS files, points flagged as withheld,
        synthetic or overlap are left out unless --keep names the flag.
OUTPUT  .vtp, .vtu (all points with their data, a column named z as third
        coordinate) or .npy (m x 3 int64: point ids, counted from 0,
        counter-clockwise); .14 (ADCIRC: node numbers and boundaries of a .14 input are
        kept; depth is the column depth or else minus z); or .tipp, a partitioned mesh, made out of core: points
        and triangles may be larger than memory. .npy .las and text are read in
        blocks, other points as a whole.

CONSTRAINTS  .poly (Triangle); .csv, .txt (a segment a line: x and y of both ends, or
        two ids of points counted from 0); .14, .grd (ADCIRC: the boundaries); any VTK
        file: lines, and polygons, of which counter-clockwise ones keep their inside
        and clockwise ones are holes. Its points that are not in INPUT are added.
        They stay in memory, on each rank.

Under mpirun the points are spread over the ranks, each with its threads; the
first rank writes the output. --masters, --major, --minor and --groups choose how
the ranks share the work. A .tipp output is written by all ranks, which must all
see its folder and that of --scratch; --memory is that of each.

Duplicates are merged, points that are not finite are left out. Ctrl-C ends the
run with exit code 130 and no output. Seconds in the summary are those of the
triangulation alone; memory is in millions of bytes.

Examples:
  tipp delaunay points.npy -o triangles.npy
  tipp delaunay tile.las --class 2 -o ground.vtu
  tipp delaunay survey.csv --x easting --y northing -o survey.vtp --threads 4
  tipp delaunay survey.csv -o survey.vtp --constraints breaklines.vtp
  tipp delaunay fort.14 -o mesh.vtu --partitions 8x8 --stats run.json
  tipp delaunay west.npy east.npy -o mesh.tipp --memory 512M
  tipp delaunay west.npy east.npy -o mesh.tipp --memory 512M --resume
  mpirun -np 4 tipp delaunay points.npy -o triangles.npy --masters multi --major 4x4
  mpirun -np 4 tipp delaunay points.npy -o mesh.tipp --memory 512M
)";

TriangulationOptions makeOptions(
  const DelaunayArguments& arguments, const std::unique_ptr<ProgressBar>& bar)
{
  const GridSize grid = *parseGrid(arguments.Partitions);
  TriangulationOptions options;
  options.Columns = grid.Columns;
  options.Rows = grid.Rows;
  options.InitialPointsPerPartition = arguments.InitialPoints;
  options.Order = arguments.Order == "dynamic" ? Schedule::Dynamic : Schedule::Stages;
  options.Threads = arguments.Threads;
  options.MaximumEdge = arguments.MaximumEdge;
  options.Progress = progressOn(bar);
  return options;
}

/// If there are constraints, appends their new points, and sets `report` to a line about them.
Triangulation triangulatePoints(
  const DelaunayArguments& arguments, PointTable& points, std::string& report)
{
  const auto bar = std::make_unique<ProgressBar>("Triangulating");
  if (arguments.Constraints.areGiven())
  {
    return triangulateWithConstraints(arguments, points, makeOptions(arguments, bar), report);
  }
  return triangulate(PointsView(points.XY.data(), points.size(), 2), makeOptions(arguments, bar));
}

int runDelaunay(const DelaunayArguments& arguments)
{
  const MpiSession session;
  if (isOutOfCore(arguments))
  {
    return runDelaunayOutOfCore(arguments, session.controller());
  }
  if (session.controller() || arguments.isForRanks())
  {
    return runDelaunayOnRanks(arguments, session.controller());
  }
  const PathState before = requireWritable(arguments);
  DelaunayRun run;
  run.Input = arguments.Input;
  run.Output = arguments.Output;
  Stopwatch watch;
  PointTable points = readPointsFor(arguments);
  run.Points = std::int64_t(points.size());
  run.ReadSeconds = watch.restart();
  reportLeftOut(points.LeftOut, points.ThinnedOut);
  if (isInterrupted())
  {
    return reportInterrupt();
  }
  std::string constraintReport;
  const Triangulation result = triangulatePoints(arguments, points, constraintReport);
  run.TriangulateSeconds = watch.restart();
  run.DisagreeingPositions = resolveDuplicates(points, result.Duplicates, arguments.Duplicates);
  if (result.Aborted || isInterrupted() || !writeResult(arguments, points, result, before))
  {
    return reportInterrupt();
  }
  run.WriteSeconds = watch.restart();
  if (!arguments.Statistics.empty())
  {
    writeStatistics(arguments.Statistics, run, result);
  }
  fmt::print("{}\n", summarize(run, result));
  if (!constraintReport.empty())
  {
    fmt::print("{}\n", constraintReport);
  }
  warnOfNoTriangles(std::int64_t(result.triangleCount()));
  return Success;
}

std::string checkOutput(const std::string& path)
{
  return isMeshFile(path) || extensionOf(path) == ".tipp"
    ? ""
    : "'" + path + "' does not end in .vtp, .vtu, .npy, .14 or .tipp";
}

std::string checkPartitions(const std::string& text)
{
  return parseGrid(text)
    ? ""
    : "'" + text + "' is neither auto nor COLUMNSxROWS of 1 to 10000 each, as 8x8";
}

std::string checkMinor(const std::string& text)
{
  return parseMinor(text) ? "" : "'" + text + "' is none of auto, COLUMNSxROWS, auto:T and tree:T";
}

void addTuning(CLI::App& command, DelaunayArguments& arguments)
{
  addThreadsOption(command, arguments.Threads);
  command
    .add_option("--partitions", arguments.Partitions,
      "Columns and rows of partitions, as 8x8, or auto: chosen for the points")
    ->check(checkPartitions)
    ->capture_default_str();
  command
    .add_option("--schedule", arguments.Order,
      "stages: independent partitions together, then the next; dynamic: each as soon as it can; "
      "producer-consumer: stages without a barrier after each shift of the ranks")
    ->check(CLI::IsMember({ "stages", "producer-consumer", "dynamic" }))
    ->capture_default_str();
  command
    .add_option("--masters", arguments.Masters,
      "auto: no master; single: one master hands out all partitions; multi: sub-masters, a major "
      "partition each")
    ->check(CLI::IsMember({ "auto", "single", "multi" }))
    ->capture_default_str();
  command
    .add_option("--major", arguments.Major,
      "Columns and rows of major partitions, as 4x4, or auto: boxes of equally many points")
    ->check(checkPartitions)
    ->capture_default_str();
  command
    .add_option("--minor", arguments.Minor,
      "Partitions of each major one: columns and rows, as 8x8; auto:T: a square grid of about T "
      "points each; tree:T: boxes of equally many points, about T; auto: tree, T chosen")
    ->check(checkMinor)
    ->capture_default_str();
  command
    .add_option("--groups", arguments.Groups,
      "Partitions and ranks are shared out by points (proportional) or by number (equal)")
    ->check(CLI::IsMember({ "proportional", "equal" }))
    ->capture_default_str();
  command
    .add_option("--initial-points", arguments.InitialPoints,
      "Points of each partition in the initial mesh; 0: chosen")
    ->check(CLI::Range(0, 1000000))
    ->capture_default_str();
}

void addConstraints(CLI::App& command, DelaunayArguments& arguments)
{
  command.add_option("--constraints", arguments.Constraints.Lines,
    "A file of segments that must be edges, and of polygons whose inside alone is kept");
  command.add_option("--boundary", arguments.Constraints.Boundary,
    "A file of closed lines: only the triangles inside of them are kept");
  command.add_flag(
    "--refuse-crossings",
    [&arguments](std::int64_t) { arguments.Constraints.Crossings = CrossingRule::Refuse; },
    "An error if two constraints cross; without: they are split at a new point");
  command.add_flag("--mark-constraints", arguments.MarkConstraints,
    "Add the cell array ConstraintEdges to .tipp: for each corner 1 if the edge opposite to it is "
    "a "
    "constraint, else 0");
  command
    .add_option("--hole", arguments.Constraints.Holes,
      "x and y of a point in a hole, whose triangles are removed up to the constraints around it; "
      "may be given several times")
    ->allow_extra_args(false);
}

void requireValidConstraints(const DelaunayArguments& arguments)
{
  if (arguments.MarkConstraints && !(arguments.Constraints.areGiven() && isOutOfCore(arguments)))
  {
    throw CLI::ValidationError(
      "--mark-constraints", "needs --constraints or --boundary, and an output named .tipp");
  }
  const bool refuses = arguments.Constraints.Crossings == CrossingRule::Refuse;
  if (!arguments.Constraints.areGiven() && (refuses || !arguments.Constraints.Holes.empty()))
  {
    throw CLI::ValidationError(refuses ? "--refuse-crossings" : "--hole", "needs --constraints");
  }
}

} // namespace

void addDelaunayCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<DelaunayArguments>();
  CLI::App* const command =
    app.add_subcommand("delaunay", "Triangulates points: exact 2D Delaunay, in parallel");
  command->add_option("input", arguments->Inputs, "The points, of one or more files")->required();
  command->add_option("-o,--output", arguments->Output, "The triangles")
    ->required()
    ->check(checkOutput);
  addPointOptions(*command, arguments->Columns);
  addDuplicatesOption(*command, arguments->Duplicates);
  addTuning(*command, *arguments);
  command
    ->add_option("--max-edge", arguments->MaximumEdge,
      "Leaves out triangles with an edge longer than this, in the units of the points")
    ->check(checkPositive);
  command->add_flag("--map-duplicates", arguments->MapDuplicates,
    "Add the point array RepresentativePointId to .vtp or .vtu: the id of the vertex that stands "
    "for a "
    "point, -1 for points that are not finite");
  command->add_flag("--neighbors", arguments->Neighbors,
    "Add the cell array NeighborIds to .vtp, .vtu or .tipp: three ids a triangle, those of the "
    "triangles opposite its corners, -1 at the hull");
  addConstraints(*command, *arguments);
  command->add_option("--stats", arguments->Statistics, "A JSON file for figures of the run");
  command
    ->add_option("--memory", arguments->Memory,
      "With a .tipp output: what each process may take, as 512M; without: 2G")
    ->check(checkMemorySize);
  command
    ->add_option("--sink", arguments->Sink,
      "With a .tipp output: mesh, or count: nothing is written but the number of triangles and "
      "a checksum of them")
    ->check(CLI::IsMember({ "mesh", "count" }))
    ->capture_default_str();
  command->add_flag("--resume", arguments->Resume,
    "With a .tipp output: goes on where a run that was killed, interrupted or failed has been");
  command->add_option("--scratch", arguments->Scratch,
    "With a .tipp output: a folder for the spilled points; without: beside the output");
  command->footer(footer);
  command->callback(
    [arguments, &exitCode]()
    {
      if (arguments->MapDuplicates && !holdsArrays(arguments->Output))
      {
        throw CLI::ValidationError(
          "--map-duplicates", "needs an output of points, so .vtp or .vtu");
      }
      if (arguments->Duplicates != DuplicateRule::First && extensionOf(arguments->Output) == ".npy")
      {
        throw CLI::ValidationError(
          "--duplicates", "needs an output of points with data, so .vtp, .vtu or .tipp");
      }
      if (arguments->Neighbors && !holdsArrays(arguments->Output))
      {
        throw CLI::ValidationError(
          "--neighbors", "needs an output of cells with data, so .vtp, .vtu or .tipp");
      }
      if (arguments->Partitions != "auto" && arguments->isForRanks())
      {
        throw CLI::ValidationError(
          "--partitions", "does not go with --masters, --major and --minor; give --minor");
      }
      arguments->Input = arguments->Inputs.front();
      arguments->Columns.Threads = arguments->Threads;
      const std::string misplaced = misplacedOutOfCoreOption(*arguments);
      requireValidConstraints(*arguments);
      if (isOutOfCore(*arguments) && arguments->isForRanks())
      {
        throw CLI::ValidationError(
          "--masters, --major and --minor", "do not go with an output named .tipp");
      }
      if (!isOutOfCore(*arguments) && !misplaced.empty())
      {
        throw CLI::ValidationError(misplaced, "needs an output named .tipp");
      }
      exitCode = runDelaunay(*arguments);
    });
}

} // namespace tipp
