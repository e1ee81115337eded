// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/RunInPieces.h"
#include "Console/Process.h"
#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/OnDisk/ConstrainedStream.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/TableConstraints.h"
#include "Distributed/ConstrainRanks.h"
#include "Distributed/DistributedTriangulation.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/PendingOutput.h"
#include "Files/RequireApart.h"
#include "Files/TextFile.h"
#include "Files/WorkFolder.h"
#include "InMemory/TriangulateTable.h"
#include "Meshes/MeshFiles.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "Parallel/Stopwatch.h"
#include "Partitioning/MeshTiling.h"
#include "Points/ReadPoints.h"
#include "Ranks/Communicator.h"
#include "Raster/RasterFile.h"
#include "Triangulation/ResolveDuplicates.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

/// The options of `tipp delaunay`.
struct DelaunayArguments : RunArguments
{
  int Threads = 0;
  std::string Partitions = "auto";
  GridSize Grid;              ///< parsed from Partitions
  DistributedOptions OnRanks; ///< made from the other options
  std::string Order = "dynamic";
  std::string Masters = "auto";
  std::string Major = "auto";
  std::string Minor = "auto";
  std::string Groups = "proportional";
  int InitialPoints = 0;
  double MaximumEdge = 0; ///< 0: not given
  bool MapDuplicates = false;
  DuplicateRule Duplicates = DuplicateRule::First;
  bool Neighbors = false;
  ConstraintFiles Constraints;
  bool MarkConstraints = false;
  std::string Sink = "mesh"; ///< of a run out of core

  /// Returns whether an option is given that needs the code for several ranks, even if there is
  /// one.
  bool isForRanks() const
  {
    return this->Masters != "auto" || this->Major != "auto" || this->Minor != "auto";
  }
};

std::string describeLeftOut(std::int64_t notFinite)
{
  return notFinite > 0 ? fmt::format(", {} left out because an end is not finite", notFinite) : "";
}

/// Returns a line about the constraints, for the report of a run.
std::string describeSegments(const ConstraintFigures& figures)
{
  return fmt::format("{} constraints of {} segments, {} crossings{}", figures.Constraints,
    figures.Segments, figures.Crossings, describeLeftOut(figures.NotFinite));
}

/// Returns an error message: constraints add points, but the output stores triangles only.
std::string describeAdded(std::int64_t points, const DelaunayArguments& arguments)
{
  return fmt::format("it adds {} points to those of {}, which an .npy output does not store; name "
                     "the output .vtp or .vtu.",
    points, arguments.Inputs.front());
}

/// Warns if boundaries are lost: they are lists of nodes, and thinning has removed some of the
/// nodes.
void warnOfLostBoundaries(const DelaunayArguments& arguments)
{
  const std::string boundaries = readAdcircNodes(arguments.Inputs.front()).Boundaries;
  constexpr std::ptrdiff_t linesOfNone = 4; // a grid without boundaries has only the counts
  if (std::count(boundaries.begin(), boundaries.end(), '\n') > linesOfNone)
  {
    fmt::print(stderr,
      "tipp: warning: {} has none of the boundaries of {}, because --thin has left out some of its "
      "nodes.\n",
      arguments.Output, arguments.Inputs.front());
  }
}

/// Reads the whole input, without the columns that the output does not store. Throws IOError.
PointTable readPointsFor(const DelaunayArguments& arguments)
{
  PointTable points = readPoints(arguments.Inputs, arguments.Columns);
  requireInBounds(arguments.Inputs, arguments.Columns, std::int64_t(points.size()), points.Figures);
  requireElevation(arguments.Duplicates, points.names());
  if (arguments.OutputIs == Opener::Npy)
  {
    points.Columns.clear(); // the file has none
  }
  return points;
}

/// Returns the reference system that the output states: that of --crs or of the files. Of the
/// formats, UGRID states one.
std::string crsOf(const DelaunayArguments& arguments, const PointTable& points)
{
  if (arguments.OutputIs != Opener::Netcdf || !arguments.Columns.Crs.empty() || points.Crs.empty())
  {
    return arguments.OutputIs == Opener::Netcdf ? arguments.Columns.Crs : "";
  }
  try
  {
    requireCrs(points.Crs);
    return points.Crs;
  }
  catch (const IOError& error)
  {
    fmt::print(stderr,
      "tipp: warning: {} The mesh states no reference system; --crs EPSG:CODE names one.\n",
      error.what());
    return "";
  }
}

/// Writes the output. `before`: from requireOutputs(). Returns false, without a file, if the user
/// interrupted it. Throws IOError.
bool writeResult(const DelaunayArguments& arguments, const PointTable& points,
  const Triangulation& result, const PathState& before)
{
  MeshOptions options;
  options.Before = before;
  options.Aborted = isInterrupted;
  options.Neighbors = arguments.Neighbors;
  options.Crs = crsOf(arguments, points);
  if (arguments.Inputs.size() == 1 && isOpenedBy(arguments.Inputs.front(), Opener::Adcirc))
  {
    if (points.ThinnedOut == 0)
    {
      options.AdcircLike = arguments.Inputs.front();
    }
    else if (arguments.OutputIs == Opener::Adcirc)
    {
      warnOfLostBoundaries(arguments);
    }
  }
  if (arguments.MapDuplicates)
  {
    const auto ids = representativeIds(result, std::int64_t(points.size()));
    options.Representatives.assign(ids.begin(), ids.end());
  }
  const TrianglesView triangles = result.Ids64.empty()
    ? TrianglesView(result.Ids32.data(), result.triangleCount())
    : TrianglesView(result.Ids64.data(), result.triangleCount());
  return writeMesh(arguments.Output, points, triangles, options);
}

/// Throws IOError if a file that is written or read beside a named one, such as x.ele beside
/// x.node, would replace an input.
void requireApartFromOthers(const std::string& output, const std::vector<std::string>& inputs)
{
  requireApart(filesOfMesh(output, false), filesOfMeshes(inputs));
}

/// Throws IOError unless the output files can be written. Call it before the computation. Returns
/// the state of the output's path; writeResult() refuses to replace anything else.
PathState requireOutputs(const DelaunayArguments& arguments)
{
  std::vector<std::string> inputs = arguments.Inputs;
  inputs.push_back(arguments.Constraints.Lines);
  inputs.push_back(arguments.Constraints.Boundary);
  requireApartFromOthers(arguments.Output, inputs);
  if (arguments.OutputIs == Opener::Netcdf && !arguments.Columns.Crs.empty())
  {
    requireCrs(arguments.Columns.Crs);
  }
  return requireWritable(arguments.Output, arguments.Statistics, inputs);
}

/// The figures of a run of `tipp delaunay`, besides the result's own statistics.
struct DelaunayRun
{
  std::int64_t DisagreeingPositions = 0; ///< positions whose points have different elevations
  std::int64_t Points = 0;
  ReadFigures Read;
  double ReadSeconds = 0; ///< all times are wall-clock seconds
  double TriangulateSeconds = 0;
  double WriteSeconds = 0;
};

/// Writes these figures and the run's statistics to the file of --stats, if there is one, and
/// prints a summary, which ends with `more`. Throws IOError.
void reportResult(const DelaunayArguments& arguments, const DelaunayRun& run,
  const nlohmann::ordered_json& statistics, const std::string& more = "")
{
  nlohmann::ordered_json json = {
    { "input", arguments.Inputs.front() },
    { "output", arguments.Output },
    { "points", run.Points },
    { "not_read", jsonOf(run.Read) },
    { "points_per_second",
      run.TriangulateSeconds > 0 ? double(run.Points) / run.TriangulateSeconds : 0 },
    { "disagreeing_places", run.DisagreeingPositions },
    { "read_seconds", run.ReadSeconds },
    { "triangulate_seconds", run.TriangulateSeconds },
    { "write_seconds", run.WriteSeconds },
    { "peak_memory_bytes", peakMemoryBytes() },
  };
  json.update(statistics);
  reportRun(arguments.Statistics, json, run.TriangulateSeconds, more);
}

/// Triangulates the points. If --constraints or --boundary are given, appends to `points` those of
/// their files that are not in it yet, and then the points where constraints cross. In the column
/// z, a new point has the height from the constraints' file; its other columns are NaN. Columns of
/// a crossing are interpolated. Sets `report` to a line about the constraints. Throws IOError.
Triangulation triangulatePoints(
  const DelaunayArguments& arguments, PointTable& points, std::string& report)
{
  const auto bar = std::make_unique<ProgressBar>("Triangulating");
  TriangulationOptions options;
  options.Columns = arguments.Grid.Columns;
  options.Rows = arguments.Grid.Rows;
  options.InitialPointsPerPartition = arguments.InitialPoints;
  options.Order = arguments.Order == "dynamic" ? Schedule::Dynamic : Schedule::Stages;
  options.Threads = arguments.Threads;
  options.MaximumEdge = arguments.MaximumEdge;
  options.Progress = progressOn(bar);
  if (!arguments.Constraints.areGiven())
  {
    return std::move(triangulateTable(points, {}, options).Mesh);
  }
  const TableConstraints constraints = readConstraints(arguments.Constraints);
  const std::size_t given = points.size();
  try
  {
    ConstrainedTriangulation result = triangulateTable(points, constraints, options);
    if (!result.Mesh.Aborted && points.size() > given && arguments.OutputIs == Opener::Npy)
    {
      throw std::invalid_argument(describeAdded(std::int64_t(points.size() - given), arguments));
    }
    report = fmt::format("{} constraints of {} edges, {} crossings{}",
      constraints.Lines.Edges.size() + constraints.Boundary.Edges.size(),
      result.Constraints.Segments.size(), result.Constraints.Crossings.size(),
      describeLeftOut(result.Constraints.NotFinite));
    return std::move(result.Mesh);
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(arguments.Constraints.name(), error.what());
  }
}

int runInMemory(const DelaunayArguments& arguments)
{
  const PathState before = requireOutputs(arguments);
  DelaunayRun run;
  Stopwatch watch;
  PointTable points = readPointsFor(arguments);
  run.Points = std::int64_t(points.size());
  run.Read = points.Figures;
  run.ReadSeconds = watch.restart();
  reportRead(points.Figures);
  reportLeftOut(points.LeftOut, points.ThinnedOut);
  LongitudeSpan span;
  span.add(points.XY);
  warnOfLongitudes(span);
  reportTables(points.Reports);
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
  const auto triangles = std::int64_t(result.triangleCount());
  reportResult(arguments, run, jsonOf(statisticsOf(result, run.Points, triangles)));
  if (!constraintReport.empty())
  {
    fmt::print("{}\n", constraintReport);
  }
  warnOfNoTriangles(triangles, arguments.MaximumEdge);
  return Success;
}

/// The constraints, which all ranks have, and data about them that only the first rank has.
struct SharedConstraints
{
  std::unique_ptr<ConstraintSegments> Segments; ///< null: no constraints
  std::vector<double> AddedXY;
  PointBlock Added; ///< on the first rank: the added points with all columns
  ConstraintFigures Figures;
};

/// Reads the constraints on the first rank, which reads all points for this, and sends them to the
/// others. Collective.
SharedConstraints shareConstraints(Communicator& ranks, const DelaunayArguments& arguments)
{
  SharedConstraints shared;
  if (!arguments.Constraints.areGiven())
  {
    return shared;
  }
  SaveArchive writer;
  if (ranks.rank() == 0)
  {
    const WorkFolder folder = WorkFolder::inSystem();
    const auto points = joinConstraints(openPointStream(arguments.Inputs, arguments.Columns),
      arguments.Constraints, arguments.Threads);
    constexpr std::uint64_t memory = std::uint64_t(1) << 30;
    points->begin(folder.path() + "/constraints", memory);
    constexpr std::size_t blockPoints = 1 << 18;
    forEachBlock(*points, blockPoints, [](PointBlock&) {});
    shared.Figures = points->figures();
    shared.Added = points->added();
    if (shared.Added.size() > 0 && arguments.OutputIs == Opener::Npy)
    {
      throw IOError(
        arguments.Constraints.name(), describeAdded(std::int64_t(shared.Added.size()), arguments));
    }
    std::vector<ConstraintSegment> segments;
    points->forEach([&segments](const ConstraintSegment& segment) { segments.push_back(segment); });
    writer(segments, shared.Added.XY);
  }
  const Bytes bytes = ranks.broadcast(writer.take());
  LoadArchive reader(bytes);
  shared.Segments =
    std::make_unique<ConstraintSegments>(reader.get<std::vector<ConstraintSegment>>());
  reader(shared.AddedXY);
  return shared;
}

/// Writes the file on the first rank, completely or not at all; the others wait for the outcome.
void writeOnFirst(Communicator& ranks, const DelaunayArguments& arguments, DelaunayRun& run,
  const DistributedTriangulation& mine, const SharedConstraints& constraints,
  const PathState& before)
{
  const Triangulation all = gatherTriangles(ranks, mine);
  if (ranks.rank() != 0)
  {
    return;
  }
  Stopwatch watch;
  // An .npy output of triangles needs no points.
  PointTable points = arguments.OutputIs == Opener::Npy ? PointTable() : readPointsFor(arguments);
  if (constraints.Added.size() > 0)
  {
    append(constraints.Added, points);
  }
  run.DisagreeingPositions = resolveDuplicates(points, all.Duplicates, arguments.Duplicates);
  if (!writeResult(arguments, points, all, before))
  {
    throw RankFailure(0, true, "interrupted");
  }
  run.WriteSeconds = watch.restart();
  const DistributedStatistics& statistics = mine.Statistics;
  nlohmann::ordered_json json = jsonOf(statisticsOf(mine));
  for (std::size_t i = 0; i < statistics.Masters.size(); ++i)
  {
    json["masters"][i]["stages"] = jsonOf(stagesOf(statistics.Masters[i].Stages));
  }
  reportResult(arguments, run, json,
    fmt::format(", {} ranks of {} threads", statistics.Ranks.size(), statistics.ThreadsPerRank));
  if (constraints.Segments)
  {
    fmt::print("{}\n", describeSegments(constraints.Figures));
  }
  warnOfNoTriangles(mine.AllCells, arguments.MaximumEdge);
}

/// Triangulates on all ranks. Every rank reads its share of the points; the first one writes the
/// output and prints messages. Collective.
void triangulateShares(Communicator& ranks, const DelaunayArguments& arguments)
{
  const PathState before = ranks.rank() == 0 ? requireOutputs(arguments) : PathState();
  DelaunayRun run;
  Stopwatch watch;
  PointTable points =
    readPointsShare(arguments.Inputs, arguments.Columns, ranks.rank(), ranks.size());
  const SharedConstraints constraints = shareConstraints(ranks, arguments);
  if (ranks.rank() == ranks.size() - 1) // the last rank, so that their ids come last
  {
    points.XY.insert(points.XY.end(), constraints.AddedXY.begin(), constraints.AddedXY.end());
  }
  ranks.barrier();
  run.ReadSeconds = watch.restart();
  LongitudeSpan span;
  span.add(points.XY);
  const std::vector<LongitudeSpan> spans = ranks.gather(span);
  if (ranks.isFirst()) // it counts the points of all files
  {
    run.Read = points.Figures;
    reportRead(points.Figures);
    reportLeftOut(points.LeftOut, points.ThinnedOut);
    for (const LongitudeSpan& other : spans)
    {
      span.add(other);
    }
    warnOfLongitudes(span);
    reportTables(points.Reports);
  }
  RankPoints input;
  input.Points = PointsView(points.XY.data(), points.size(), 2);
  DistributedOptions options = arguments.OnRanks;
  auto bar = ranks.isFirst() ? std::make_unique<ProgressBar>("Triangulating") : nullptr;
  options.Progress = progressOn(bar);
  DistributedTriangulation mine = triangulateDistributed(ranks, input, options);
  if (constraints.Segments)
  {
    constrainRanks(ranks, *constraints.Segments, options.Threads, mine);
  }
  leaveOutLong(ranks, arguments.MaximumEdge, mine);
  bar.reset();
  run.Points = mine.AllPoints;
  run.TriangulateSeconds = watch.restart();
  writeOnFirst(ranks, arguments, run, mine, constraints, before);
}

OutOfCoreOptions makeOptions(const DelaunayArguments& arguments)
{
  OutOfCoreOptions options;
  arguments.setOptions(options);
  options.Columns = arguments.Grid.Columns;
  options.Rows = arguments.Grid.Rows;
  options.Threads = arguments.Threads;
  options.MaximumEdge = arguments.MaximumEdge;
  options.MapDuplicates = arguments.MapDuplicates;
  options.Duplicates = arguments.Duplicates;
  options.Neighbors = arguments.Neighbors;
  options.MarkConstraints = arguments.MarkConstraints;
  options.CountOnly = arguments.Sink == "count";
  return options;
}

void reportMade(
  const DelaunayArguments& arguments, const OutOfCoreStatistics& statistics, const RankUsage& usage)
{
  const bool isCounted = arguments.Sink == "count";
  const double seconds = totalSeconds(statistics.Phases);
  nlohmann::ordered_json json = { { "input", arguments.Inputs }, { "output", arguments.Output } };
  json.update(jsonOf(statisticsOf(statistics, isCounted)));
  json.update({
    { "read_bytes", usage.Read },
    { "written_bytes", usage.Written },
    { "seconds", seconds },
    { "peak_memory_bytes", *std::max_element(usage.PeakMemory.begin(), usage.PeakMemory.end()) },
    { "rank_memory_bytes", usage.PeakMemory },
    { "ranks", usage.PeakMemory.size() },
  });
  reportLeftOut(statistics.LeftOut, statistics.ThinnedOut);
  reportRun(arguments.Statistics, json, seconds,
    std::string(usage.PeakMemory.size() == 1 ? "" : " of the largest rank") +
      (isCounted ? fmt::format(", checksum {:016x}", statistics.TriangleSum) : ""));
  if (statistics.Constraints.Constraints > 0)
  {
    fmt::print("{}\n", describeSegments(statistics.Constraints));
  }
  warnOfNoTriangles(statistics.Triangles, arguments.MaximumEdge);
}

int makeInPieces(const DelaunayArguments& arguments, vtkMultiProcessController* controller)
{
  const OutOfCoreOptions options = makeOptions(arguments);
  return runInPieces<OutOfCoreStatistics>(
    controller, "Triangulating", arguments, options,
    [&](std::unique_ptr<PointStream> points)
    {
      return joinConstraints(
        std::move(points), arguments.Constraints, options.MarkConstraints, options.Threads);
    },
    [&](const OutOfCoreStatistics& statistics, const RankUsage& usage)
    { reportMade(arguments, statistics, usage); });
}

/// Returns what the help says about the input.
std::string describeInput()
{
  return paragraph("INPUT",
    "-: text from standard input; " + describePointFormats() +
      ". Several files with the same columns are one set of points. With a .tipp output also "
      "uniform:COUNT: that many random points, uniform in the unit square. Points of LAS files "
      "flagged as withheld, synthetic or overlap are left out unless --keep names the flag.");
}

constexpr const char* footer =
  R"(OUTPUT  .vtp, .vtu (all points with their data, a column named z as third
        coordinate); .npy (m x 3 int64: point ids, counted from 0, counter-clockwise);
        .14, .gr3 (ADCIRC, SCHISM: node numbers and boundaries of such an input are
        kept; depth is the column depth, else minus z); .2dm (SMS), .msh (Gmsh 2.2):
        z is the elevation, else minus depth; .node or .ele (Triangle: both files are
        written, with all columns as attributes, z first); .nc (NetCDF by UGRID: all
        columns); or .tipp: a partitioned
        mesh, made out of core. Points and triangles may then be larger than memory:
        .npy, .las, text and files of a GIS are read in blocks, other files as a whole.

CONSTRAINTS  .poly (Triangle); .csv, .txt (a segment per line: x and y of both ends, or
        two ids of points counted from 0); .14, .grd, .gr3 (the boundaries); any VTK
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
  tipp delaunay tiles/*.laz --bounds 5000 6000 2000 3000 -o part.vtu
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
  addCurveOption(command);
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
  addRunOptions(command, arguments, "The triangles", Use::WritesTriangles | Use::WritesPieces,
    "With a .tipp output: the memory limit of each process, such as 512M (default: 2G)",
    "With a .tipp output");
  addBoundsOption(command, arguments.Columns);
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
  const Opener output = arguments.OutputIs;
  const bool hasArrays = output == Opener::Vtk || output == Opener::Pieces;
  refuseIf(arguments.MapDuplicates && !hasArrays, "--map-duplicates",
    "needs an output named .vtp or .vtu, which has all points");
  refuseIf(arguments.Duplicates != DuplicateRule::First && output == Opener::Npy, "--duplicates",
    "needs an output named .vtp, .vtu or .tipp, which has point data");
  refuseIf(arguments.Neighbors && !hasArrays, "--neighbors",
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

/// Sets what the runs take from several options.
void complete(DelaunayArguments& arguments)
{
  arguments.Columns.Threads = arguments.Threads;
  arguments.Constraints.Wrap = arguments.Columns.Wrap;
  arguments.Grid = *parseGrid(arguments.Partitions);
  arguments.OnRanks = makeDistributedOptions(arguments);
}

int run(DelaunayArguments& arguments)
{
  arguments.OutputIs = openerOf(arguments.Output, Use::WritesTriangles | Use::WritesPieces);
  requireFitting(arguments);
  complete(arguments);
  const MpiSession session;
  if (arguments.makesPieces())
  {
    return makeInPieces(arguments, session.controller());
  }
  return session.controller() || arguments.isForRanks()
    ? runTogether(
        session.controller(), [&](Communicator& ranks) { triangulateShares(ranks, arguments); })
    : runInMemory(arguments);
}

} // namespace

void addDelaunayCommand(CLI::App& app, int& exitCode)
{
  addCommand<DelaunayArguments>(app, exitCode, "delaunay",
    "Triangulates points: exact 2D Delaunay, in parallel", describeInput() + footer, addOptions,
    run);
}

} // namespace tipp
