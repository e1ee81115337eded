// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/RunInPieces.h"
#include "Console/Process.h"
#include "Distributed3D/DistributedTetrahedralization.h"
#include "Files/Formats.h"
#include "Files/PendingOutput.h"
#include "Files/Platform.h"
#include "InMemory/TriangulatePoints.h"
#include "Meshes/MeshFiles.h"
#include "OutOfCore/OutOfCoreTetrahedralization.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Ranks/Communicator.h"
#include "Statistics/RunStatistics.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The options of `tipp delaunay3d`.
struct Delaunay3DArguments : RunArguments
{
  int Threads = 0;
  int Partitions = 0;
  bool MapDuplicates = false;
  bool Neighbors = false;
};

/// Returns the points in space. Throws IOError if there is no column with the third coordinate.
std::vector<Point3> coordinatesOf(const PointTable& table, const Delaunay3DArguments& arguments)
{
  std::vector<Point3> points(table.size());
  const std::vector<double>& z =
    table.Columns[requireElevation(table, arguments.Inputs.front())].Values;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { table.XY[2 * i], table.XY[2 * i + 1], z[i] };
  }
  return points;
}

/// Writes the tetrahedra, or the triangles of coplanar points. `before`: from requireWritable().
/// Returns false, without a file, if the user interrupted it. Throws IOError.
bool writeResult(const Delaunay3DArguments& arguments, PointTable&& table,
  const Tetrahedralization& mesh, const Triangulation& triangles, const PathState& before)
{
  MeshOptions options;
  options.Before = before;
  options.Aborted = isInterrupted;
  if (arguments.MapDuplicates)
  {
    const auto ids = representativeIds(mesh, std::int64_t(table.size()));
    options.Representatives.assign(ids.begin(), ids.end());
  }
  if (mesh.Dimension == 2)
  {
    options.Neighbors = arguments.Neighbors;
    table.Columns[requireElevation(table, arguments.Inputs.front())].Name = "z";
    return writeMesh(
      arguments.Output, table, { triangles.Ids32.data(), triangles.triangleCount() }, options);
  }
  std::vector<std::int64_t> neighbors;
  if (arguments.Neighbors)
  {
    const auto found = neighborIds(mesh);
    neighbors.assign(found.begin(), found.end());
  }
  return writeTetrahedra(
    arguments.Output, std::move(table), mesh.Ids.data(), mesh.cellCount(), neighbors, options);
}

/// Reports the run, see reportRun(); the summary ends with `ranks`.
void report(const Delaunay3DArguments& arguments, const Tetrahedralization& mesh,
  const Triangulation& triangles, double seconds, const RunStatistics& statistics,
  const std::string& ranks)
{
  nlohmann::ordered_json json = { { "input", arguments.Inputs }, { "output", arguments.Output },
    { "tetrahedralize_seconds", seconds }, { "peak_memory_bytes", peakMemoryBytes() } };
  json.update(jsonOf(statistics));
  if (mesh.Dimension == 2)
  {
    json["triangles"] = triangles.triangleCount();
  }
  reportRun(arguments.Statistics, json, seconds, ranks);
}

constexpr const char* footer =
  R"(INPUT   files as for 'tipp delaunay'. The third coordinate is the column z, Z or elevation,
        or the third column of a file without names. With a .tipp output also
        uniform:COUNT: that many random points, uniform in the unit cube.
OUTPUT  .vtu (all points with their data) or .npy (m x 4 int64: point ids, counted
        from 0): computed in memory. Or .tipp: a partitioned mesh in a folder. Points
        and tetrahedra may then be larger than memory, which --memory limits.

If all points are in one plane, there is a warning, and triangles are written to .vtu or
.npy: the Delaunay triangulation of the points' projection along the axis nearest to the
plane's normal.

Duplicates are merged, points that are not finite are left out. Ctrl-C stops the run
with exit code 130 and no output; --resume continues a run with a .tipp output. The
summary shows the seconds of the tetrahedralization alone (for .tipp, of the whole run)
and memory in millions of bytes. Under mpirun the points are distributed among the
ranks, each with its threads, and the first rank writes the output, which is that of one
process; a .tipp is made by the first rank alone.

Examples:
  tipp delaunay3d particles.npy -o mesh.vtu
  tipp delaunay3d cloud.las --class 2,5 -o tetrahedra.npy --threads 4
  tipp delaunay3d uniform:50000000 -o mesh.tipp --memory 2G
  tipp delaunay3d uniform:50000000 -o mesh.tipp --memory 2G --resume
  mpirun -np 4 tipp delaunay3d particles.npy -o mesh.vtu --threads 2
)";

TetrahedralizationOptions makeOptions(
  const Delaunay3DArguments& arguments, const std::unique_ptr<ProgressBar>& bar)
{
  TetrahedralizationOptions options;
  options.Partitions = arguments.Partitions;
  options.Threads = arguments.Threads;
  options.Progress = progressOn(bar);
  return options;
}

int runInMemory(const Delaunay3DArguments& arguments)
{
  const PathState before =
    requireWritable(arguments.Output, arguments.Statistics, arguments.Inputs);
  PointTable table = readPoints(arguments.Inputs, arguments.Columns);
  const auto count = std::int64_t(table.size());
  requireInBounds(arguments.Inputs, arguments.Columns, count, table.Figures);
  reportRead(table.Figures);
  reportLeftOut(table.LeftOut, table.ThinnedOut);
  reportTables(table.Reports);
  const std::vector<Point3> points = coordinatesOf(table, arguments);
  if (isInterrupted())
  {
    return reportInterrupt();
  }
  Tetrahedralization mesh;
  Triangulation triangles; // if the points are coplanar
  const Stopwatch watch;
  {
    const auto bar = std::make_unique<ProgressBar>("Tetrahedralizing");
    mesh =
      tetrahedralizePoints(points.data(), points.size(), 0, makeOptions(arguments, bar), triangles);
  }
  const double seconds = watch.seconds();
  if (mesh.Aborted || isInterrupted() ||
    !writeResult(arguments, std::move(table), mesh, triangles, before))
  {
    return reportInterrupt();
  }
  report(arguments, mesh, triangles, seconds,
    statisticsOf(mesh, count, std::int64_t(mesh.cellCount())), "");
  printWarnings(warningsOf(mesh, count));
  return Success;
}

/// Returns this rank's share of the points.
std::vector<Point3> readShare(const Communicator& ranks, const Delaunay3DArguments& arguments)
{
  const PointTable table =
    readPointsShare(arguments.Inputs, arguments.Columns, ranks.rank(), ranks.size());
  if (ranks.isFirst()) // it counts the points of all files
  {
    reportRead(table.Figures);
    reportLeftOut(table.LeftOut, table.ThinnedOut);
    reportTables(table.Reports);
  }
  return table.size() == 0 && !ranks.isFirst() ? std::vector<Point3>()
                                               : coordinatesOf(table, arguments);
}

/// Writes the file on the first rank, completely or not at all; the others wait for the outcome.
void writeOnFirst(Communicator& ranks, const Delaunay3DArguments& arguments,
  const DistributedTetrahedralization& mine, double seconds, const PathState& before)
{
  Triangulation triangles; // of coplanar points
  const Tetrahedralization all = gatherTetrahedra(ranks, mine, arguments.Threads, triangles);
  if (!ranks.isFirst())
  {
    return;
  }
  // An .npy output of tetrahedra needs no points.
  PointTable table = arguments.OutputIs == Opener::Npy && all.Dimension != 2
    ? PointTable()
    : readPoints(arguments.Inputs, arguments.Columns);
  if (!writeResult(arguments, std::move(table), all, triangles, before))
  {
    throw RankFailure(0, true, "interrupted");
  }
  report(arguments, all, triangles, seconds, statisticsOf(mine),
    fmt::format(", {} ranks of {} threads", ranks.size(), mine.Statistics.ThreadsPerRank));
  printWarnings(warningsOf(mine));
}

/// Triangulates on all ranks, in memory. Every rank reads its share of the points; the first one
/// writes the output and prints messages. Collective.
void triangulateShares(Communicator& ranks, const Delaunay3DArguments& arguments)
{
  const PathState before = ranks.isFirst()
    ? requireWritable(arguments.Output, arguments.Statistics, arguments.Inputs)
    : PathState();
  const std::vector<Point3> own = readShare(ranks, arguments);
  ranks.barrier();
  const Stopwatch watch;
  RankPoints3 points;
  points.Points = { own.data(), own.size() };
  auto bar = ranks.isFirst() ? std::make_unique<ProgressBar>("Tetrahedralizing") : nullptr;
  const DistributedTetrahedralization mine =
    tetrahedralizeDistributed(ranks, points, makeOptions(arguments, bar));
  bar.reset();
  writeOnFirst(ranks, arguments, mine, watch.seconds(), before);
}

void reportMade(const Delaunay3DArguments& arguments, const OutOfCoreStatistics3& statistics,
  const RankUsage& usage)
{
  const double seconds = totalSeconds(statistics.Phases);
  nlohmann::ordered_json json = { { "input", arguments.Inputs }, { "output", arguments.Output },
    { "seconds", seconds },
    { "peak_memory_bytes", *std::max_element(usage.PeakMemory.begin(), usage.PeakMemory.end()) },
    { "ranks", usage.PeakMemory.size() } };
  json.update(jsonOf(statisticsOf(statistics)));
  reportLeftOut(statistics.LeftOut, statistics.ThinnedOut);
  reportRun(arguments.Statistics, json, seconds,
    usage.PeakMemory.size() == 1 ? "" : " of the largest rank");
  printWarnings(warningsOf(statistics));
}

int makeInPieces(const Delaunay3DArguments& arguments, vtkMultiProcessController* controller)
{
  OutOfCoreOptions3 options;
  arguments.setOptions(options);
  options.Threads = arguments.Threads;
  options.MapDuplicates = arguments.MapDuplicates;
  options.Neighbors = arguments.Neighbors;
  return runInPieces<OutOfCoreStatistics3>(
    controller, "Tetrahedralizing", arguments, options,
    [](std::unique_ptr<PointStream> points) { return points; },
    [&](const OutOfCoreStatistics3& statistics, const RankUsage& usage)
    { reportMade(arguments, statistics, usage); });
}

/// Throws CLI::ValidationError for options that the kind of output does not support.
void requireFitting(const Delaunay3DArguments& arguments)
{
  const bool hasNoArrays = arguments.OutputIs == Opener::Npy;
  constexpr const char* needsArrays = "needs an output named .vtu or .tipp";
  refuseIf(arguments.Neighbors && hasNoArrays, "--neighbors", needsArrays);
  refuseIf(arguments.MapDuplicates && hasNoArrays, "--map-duplicates", needsArrays);
  refuseIf(arguments.Partitions > 0 && arguments.makesPieces(), "--partitions",
    "needs an output named .vtu or .npy; for .tipp, --memory determines the partitions");
  arguments.refuseMisplaced();
}

void addOptions(CLI::App& command, Delaunay3DArguments& arguments)
{
  addRunOptions(command, arguments, "The tetrahedra", Use::WritesTetrahedra | Use::WritesPieces,
    "With a .tipp output: the memory limit of each process, such as 512M (default: 2G)",
    "With a .tipp output");
  addBoundsOption(command, arguments.Columns);
  addThreadsOption(command, arguments.Threads);
  addChecked(command, "--partitions", arguments.Partitions, CLI::Range(0, 512),
    "The number of partitions; 0: chosen automatically");
  addArrayFlags(command, arguments.MapDuplicates, arguments.Neighbors, "", "", "tetrahedron");
}

int run(Delaunay3DArguments& arguments)
{
  arguments.OutputIs = openerOf(arguments.Output, Use::WritesTetrahedra | Use::WritesPieces);
  requireFitting(arguments);
  arguments.Columns.InSpace = true;
  arguments.Columns.Threads = arguments.Threads;
  const MpiSession session;
  if (arguments.makesPieces())
  {
    return makeInPieces(arguments, session.controller());
  }
  return session.controller() ? runTogether(session.controller(),
                                  [&](Communicator& ranks) { triangulateShares(ranks, arguments); })
                              : runInMemory(arguments);
}

} // namespace

void addDelaunay3DCommand(CLI::App& app, int& exitCode)
{
  addCommand<Delaunay3DArguments>(app, exitCode, "delaunay3d",
    "Tetrahedralizes points: exact 3D Delaunay, in parallel", footer, addOptions, run);
}

} // namespace tipp
