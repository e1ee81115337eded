// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayRuns.h"

#include "Adcirc/AdcircGrid.h"
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Constraints/OnDisk/ConstrainedPoints.h"
#include "Distributed/ConstrainRanks.h"
#include "Distributed/DistributedTriangulation.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/PendingOutput.h"
#include "Files/TemporaryFiles.h"
#include "Meshes/MeshFiles.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Ranks/Communicator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

namespace tipp
{
namespace
{

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
  requireElevation(arguments.Duplicates, points.names());
  if (extensionOf(arguments.Output) == ".npy")
  {
    points.Columns.clear(); // only .vtp and .vtu store the columns
  }
  return points;
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
  if (arguments.Inputs.size() == 1 && isAdcircFile(arguments.Inputs.front()))
  {
    if (points.ThinnedOut == 0)
    {
      options.AdcircLike = arguments.Inputs.front();
    }
    else if (isAdcircFile(arguments.Output))
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

/// Throws IOError unless the output files can be written. Call it before the computation. Returns
/// the state of the output's path; writeResult() refuses to replace anything else.
PathState requireOutputs(const DelaunayArguments& arguments)
{
  std::vector<std::string> inputs = arguments.Inputs;
  inputs.push_back(arguments.Constraints.Lines);
  inputs.push_back(arguments.Constraints.Boundary);
  return requireWritable(arguments.Output, arguments.Statistics, inputs);
}

/// The figures of a run of `tipp delaunay`, besides the result's own statistics.
struct DelaunayRun
{
  std::int64_t DisagreeingPositions = 0; ///< positions whose points have different elevations
  std::int64_t Points = 0;
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
    return triangulate(PointsView(points.XY.data(), points.size(), 2), options);
  }
  const TableConstraints constraints = readConstraints(arguments.Constraints);
  const std::size_t given = points.size();
  try
  {
    ConstrainedTriangulation result = triangulateTable(points, constraints, options);
    if (!result.Mesh.Aborted && points.size() > given && extensionOf(arguments.Output) == ".npy")
    {
      throw std::invalid_argument(describeAdded(std::int64_t(points.size() - given), arguments));
    }
    report = fmt::format("{} constraints of {} edges, {} crossings{}",
      constraints.Lines.Edges.size() + constraints.Boundary.Edges.size(),
      result.Constraints.Pieces.size(), result.Constraints.Crossings.size(),
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
  run.ReadSeconds = watch.restart();
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
  warnOfNoTriangles(triangles);
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
    const ScratchDirectory folder;
    const auto points = joinConstraints(openPointStream(arguments.Inputs, arguments.Columns),
      arguments.Constraints, arguments.Threads);
    constexpr std::uint64_t memory = std::uint64_t(1) << 30;
    points->begin(folder.path() + "/constraints", memory);
    constexpr std::size_t blockPoints = 1 << 18;
    forEachBlock(*points, blockPoints, [](PointBlock&) {});
    shared.Figures = points->figures();
    shared.Added = points->added();
    if (shared.Added.size() > 0 && extensionOf(arguments.Output) == ".npy")
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
  PointTable points =
    extensionOf(arguments.Output) == ".npy" ? PointTable() : readPointsFor(arguments);
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
  warnOfNoTriangles(mine.AllCells);
}

/// Triangulates on all ranks. Every rank reads its share of the points; the first one writes the
/// output and prints messages. Collective.
void triangulateShares(Communicator& ranks, const DelaunayArguments& arguments)
{
  if (arguments.MaximumEdge > 0)
  {
    throw std::runtime_error("--max-edge needs one rank, or an output named .tipp.");
  }
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
  warnOfNoTriangles(statistics.Triangles);
}

/// Runs `tipp delaunay` out of core on the ranks of a controller, or in this process alone (null).
/// Returns the exit code, which is the same on all ranks.
int runInPieces(const DelaunayArguments& arguments, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  const OutOfCoreOptions options = makeOptions(arguments);
  const auto open = [&]
  {
    if (ranks.rank() == 0)
    {
      checkOutputs(arguments.Output, arguments.Statistics, arguments.Scratch, arguments.Inputs);
    }
    auto points = openPointStream(arguments.Inputs, withThinningFile(arguments));
    if (ranks.rank() == 0)
    {
      reportTables(points->reports());
    }
    return joinConstraints(std::move(points), arguments.Constraints, options);
  };
  OutOfCoreStatistics statistics;
  const int code =
    runOutOfCore(ranks, "Triangulating", open, arguments.Output, options, statistics);
  if (code != Success)
  {
    return code;
  }
  const RankUsage usage = gatherUsage(ranks);
  if (ranks.rank() == 0)
  {
    reportMade(arguments, statistics, usage);
  }
  return Success;
}

} // namespace

int runDelaunay(const DelaunayArguments& arguments)
{
  const MpiSession session;
  if (arguments.makesPieces())
  {
    return runInPieces(arguments, session.controller());
  }
  return session.controller() || arguments.isForRanks()
    ? runTogether(
        session.controller(), [&](Communicator& ranks) { triangulateShares(ranks, arguments); })
    : runInMemory(arguments);
}

} // namespace tipp
