// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Adcirc/AdcircGrid.h"
#include "Commands/DelaunayRuns.h"
#include "Commands/PointArguments.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Meshes/MeshFiles.h"
#include "Partitioning/MeshTiling.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(INPUT   -: text from standard input; .npy (n x 2 or n x 3, float64 or float32); .csv,
        .txt, .xyz (a point per line, columns separated by comma, semicolon, tab or
        blanks; a first line of names or of the count is recognized); .las (1.0 to 1.4),
        .laz if built with LASzip; .14, .grd (ADCIRC); any VTK file. Several files with
        the same columns are one set of points. With a .tipp output also uniform:COUNT:
        that many random points, uniform in the unit square. Points of LAS files flagged
        as withheld, synthetic or overlap are left out unless --keep names the flag.
OUTPUT  .vtp, .vtu (all points with their data, a column named z as third
        coordinate); .npy (m x 3 int64: point ids, counted from 0, counter-clockwise);
        .14 (ADCIRC: node numbers and boundaries of a .14 input are kept; depth is the
        column depth, else minus z); or .tipp: a partitioned mesh, made out of core.
        Points and triangles may then be larger than memory: .npy, .las and text are
        read in blocks, other files as a whole.

CONSTRAINTS  .poly (Triangle); .csv, .txt (a segment per line: x and y of both ends, or
        two ids of points counted from 0); .14, .grd (ADCIRC: the boundaries); any VTK
        file: lines and polygons. Only triangles inside of counter-clockwise polygons
        are kept; clockwise ones are holes. Points that are not in INPUT are added.
        Constraints stay in memory, on each rank, unless the output is named .tipp.

Under mpirun the points are distributed among the ranks, each with its threads; the
first rank writes the output. --masters, --major, --minor and --groups choose how
the ranks share the work. A .tipp output is written by all ranks, which must all
see its folder and that of --scratch; --memory is the limit of each.

Duplicates are merged, points that are not finite are left out. Ctrl-C stops the
run with exit code 130 and no output. The summary shows the seconds of the
triangulation alone and memory in millions of bytes.

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

/// Parses "auto", which gives no columns and rows, or a grid such as "8x8"; nullopt for other text.
std::optional<GridSize> parseGrid(const std::string& text)
{
  if (text == "auto")
  {
    return GridSize{};
  }
  const std::optional<TilingChoice> choice = TilingChoice::parse("grid:" + text);
  const bool isFlat = std::count(text.begin(), text.end(), 'x') == 1; // has no layers
  return choice && isFlat ? std::make_optional(GridSize{ choice->Boxes[0], choice->Boxes[1] })
                          : std::nullopt;
}

/// Parses "auto", a grid such as "8x8", "auto:T" or "tree:T", and sets how a major partition is
/// divided into minor ones. Returns false for other text.
bool parseMinor(const std::string& text, DistributedOptions& options)
{
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
  {
    const std::optional<GridSize> grid = parseGrid(text);
    options.Minor = grid.value_or(GridSize());
    options.MinorDivision = options.Minor.isGiven() ? Division::Grid : Division::Tree;
    return grid.has_value();
  }
  const std::string kind = text.substr(0, colon);
  const auto threshold = wholeNumber<std::int64_t>(text.substr(colon + 1));
  options.MinorDivision = kind == "auto" ? Division::Threshold : Division::Tree;
  options.Threshold = threshold.value_or(0);
  return options.Threshold >= 1 && (kind == "auto" || kind == "tree");
}

/// Returns the options of a run on ranks.
DistributedOptions makeDistributedOptions(const DelaunayArguments& arguments)
{
  DistributedOptions options;
  options.Design = arguments.Masters == "single" ? Masters::Single
    : arguments.Masters == "multi"               ? Masters::Multi
                                                 : Masters::Auto;
  options.Order = arguments.Order == "stages" ? RankSchedule::Stages
    : arguments.Order == "producer-consumer"  ? RankSchedule::ProducerConsumer
                                              : RankSchedule::Dynamic;
  options.Groups = arguments.Groups == "equal" ? GroupSizes::Equal : GroupSizes::Proportional;
  options.Major = *parseGrid(arguments.Major);
  parseMinor(arguments.Minor, options);
  if (arguments.Grid.isGiven() && !arguments.isForRanks())
  {
    options.MinorDivision = Division::Grid;
    options.Minor = arguments.Grid;
  }
  options.InitialPointsPerPartition = arguments.InitialPoints;
  options.Threads = arguments.Threads;
  return options;
}

/// Returns whether a file of this kind stores arrays of points and cells; .npy and .14 do not.
bool holdsArrays(const std::string& path)
{
  return extensionOf(path) != ".npy" && !isAdcircFile(path);
}

bool isOutput(const std::string& path)
{
  return isMeshFile(path) || extensionOf(path) == ".tipp";
}

std::string checkPartitions(const std::string& text)
{
  return parseGrid(text)
    ? ""
    : "'" + text + "' is neither auto nor COLUMNSxROWS of 1 to 10000 each, such as 8x8";
}

std::string checkMinor(const std::string& text)
{
  DistributedOptions ignored;
  return parseMinor(text, ignored) ? ""
                                   : "'" + text + "' is not auto, COLUMNSxROWS, auto:T or tree:T";
}

void addTuning(CLI::App& command, DelaunayArguments& arguments)
{
  addThreadsOption(command, arguments.Threads);
  addChecked(command, "--partitions", arguments.Partitions, checkPartitions,
    "Columns and rows of partitions, such as 8x8; auto: chosen automatically");
  addChecked(command, "--schedule", arguments.Order,
    CLI::IsMember({ "stages", "producer-consumer", "dynamic" }),
    "dynamic: each partition as soon as those that it waits for are done; stages: all "
    "independent partitions, then a barrier; producer-consumer: as stages, but a free rank takes "
    "the next partition of a stage at once");
  addChecked(command, "--masters", arguments.Masters, CLI::IsMember({ "auto", "single", "multi" }),
    "auto: no master; single: one master starts all partitions; multi: a sub-master for each "
    "major partition");
  addChecked(command, "--major", arguments.Major, checkPartitions,
    "Columns and rows of major partitions, such as 4x4; auto: boxes of equally many points");
  addChecked(command, "--minor", arguments.Minor, checkMinor,
    "Minor partitions of a major one: columns and rows, such as 8x8; auto:T: a square grid, "
    "about T points each; tree:T: boxes of equally many points, about T each; auto: a tree, T "
    "chosen automatically");
  addChecked(command, "--groups", arguments.Groups, CLI::IsMember({ "proportional", "equal" }),
    "Distribute partitions and ranks by points (proportional) or by number (equal)");
  addChecked(command, "--initial-points", arguments.InitialPoints, CLI::Range(0, 1000000),
    "Points of each partition in the initial mesh; 0: chosen automatically");
}

void addConstraints(CLI::App& command, DelaunayArguments& arguments)
{
  command.add_option("--constraints", arguments.Constraints.Lines,
    "A file of segments that must be edges, and of polygons outside of which triangles are "
    "removed");
  command.add_option("--boundary", arguments.Constraints.Boundary,
    "A file of closed lines, outside of which triangles are removed");
  command.add_flag(
    "--refuse-crossings",
    [&arguments](std::int64_t) { arguments.Constraints.Crossings = CrossingRule::Refuse; },
    "Fail if two constraints cross; otherwise they are split at a new point");
  command.add_flag("--mark-constraints", arguments.MarkConstraints,
    "Add the cell array ConstraintEdges to .tipp: for each corner 1 if the edge opposite to it is "
    "a constraint, else 0");
  command
    .add_option("--hole", arguments.Constraints.Holes,
      "x and y of a point in a hole: triangles are removed from there up to the constraints around "
      "it; may be given several times")
    ->allow_extra_args(false);
}

void requireValidConstraints(const DelaunayArguments& arguments)
{
  refuseIf(
    arguments.MarkConstraints && !(arguments.Constraints.areGiven() && arguments.makesPieces()),
    "--mark-constraints", "needs --constraints or --boundary, and an output named .tipp");
  const bool refuses = arguments.Constraints.Crossings == CrossingRule::Refuse;
  refuseIf(!arguments.Constraints.areGiven() && (refuses || !arguments.Constraints.Holes.empty()),
    refuses ? "--refuse-crossings" : "--hole", "needs --constraints");
}

void addOptions(CLI::App& command, DelaunayArguments& arguments)
{
  addRunOptions(command, arguments, "The triangles", isOutput, ".vtp, .vtu, .npy, .14 or .tipp",
    "With a .tipp output: the memory limit of each process, such as 512M (default: 2G)",
    "With a .tipp output");
  addDuplicatesOption(command, arguments.Duplicates);
  addTuning(command, arguments);
  command
    .add_option("--max-edge", arguments.MaximumEdge,
      "Leave out triangles with an edge longer than this, in the units of the points")
    ->check(checkPositive);
  addArrayFlags(command, arguments.MapDuplicates, arguments.Neighbors, " to .vtp or .vtu",
    " to .vtp, .vtu or .tipp", "triangle");
  addConstraints(command, arguments);
  addChecked(command, "--sink", arguments.Sink, CLI::IsMember({ "mesh", "count" }),
    "With a .tipp output: mesh: write it; count: only print the number of triangles and their "
    "checksum");
}

/// Throws CLI::ValidationError for options that would have no effect or contradict each other.
void requireFitting(const DelaunayArguments& arguments)
{
  refuseIf(arguments.MapDuplicates && !holdsArrays(arguments.Output), "--map-duplicates",
    "needs an output named .vtp or .vtu, which has all points");
  refuseIf(arguments.Duplicates != DuplicateRule::First && extensionOf(arguments.Output) == ".npy",
    "--duplicates", "needs an output named .vtp, .vtu or .tipp, which has point data");
  refuseIf(arguments.Neighbors && !holdsArrays(arguments.Output), "--neighbors",
    "needs an output named .vtp, .vtu or .tipp, which has cell data");
  refuseIf(arguments.Partitions != "auto" && arguments.isForRanks(), "--partitions",
    "cannot be combined with --masters, --major and --minor; give --minor");
  requireValidConstraints(arguments);
  refuseIf(arguments.makesPieces() && arguments.isForRanks(), "--masters, --major and --minor",
    "cannot be combined with an output named .tipp");
  refuseIf(
    arguments.Sink != "mesh" && !arguments.makesPieces(), "--sink", "needs an output named .tipp");
  arguments.refuseMisplaced();
}

int run(DelaunayArguments& arguments)
{
  requireFitting(arguments);
  arguments.Columns.Threads = arguments.Threads;
  arguments.Constraints.Wrap = arguments.Columns.Wrap;
  arguments.Grid = *parseGrid(arguments.Partitions);
  arguments.OnRanks = makeDistributedOptions(arguments);
  return runDelaunay(arguments);
}

} // namespace

void addDelaunayCommand(CLI::App& app, int& exitCode)
{
  addCommand<DelaunayArguments>(app, exitCode, "delaunay",
    "Triangulates points: exact 2D Delaunay, in parallel", footer, addOptions, run);
}

} // namespace tipp
