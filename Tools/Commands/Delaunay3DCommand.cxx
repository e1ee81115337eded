// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Commands/Delaunay3DRuns.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/InputFile.h"
#include "InMemory/TriangulatePoints.h"
#include "Meshes/MeshFiles.h"
#include "OutOfCore3D/OutOfCoreTetrahedralization.h"
#include "Parallel/Stopwatch.h"
#include "Points/PointStream.h"
#include "Points/ReadPoints.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <malloc.h>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

std::vector<Point3> coordinatesOf(const PointTable& table, std::size_t elevation)
{
  std::vector<Point3> points(table.size());
  const std::vector<double>& z = table.Columns[elevation].Values;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { table.XY[2 * i], table.XY[2 * i + 1], z[i] };
  }
  return points;
}

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
    const auto found = neighborIds(mesh, table.size());
    neighbors.assign(found.begin(), found.end());
  }
  return writeTetrahedra(
    arguments.Output, std::move(table), mesh.Ids.data(), mesh.cellCount(), neighbors, options);
}

void report(const Delaunay3DArguments& arguments, const Tetrahedralization& mesh,
  const Triangulation& triangles, std::int64_t points, double seconds,
  const RunStatistics& statistics, const std::string& ranks)
{
  if (!arguments.Statistics.empty())
  {
    nlohmann::ordered_json json = { { "input", arguments.Inputs }, { "output", arguments.Output },
      { "tetrahedralize_seconds", seconds }, { "peak_memory_bytes", peakMemoryBytes() } };
    json.update(jsonOf(statistics));
    if (mesh.Dimension == 2)
    {
      json["triangles"] = triangles.triangleCount();
    }
    writeJson(arguments.Statistics, json);
  }
  fmt::print("{} points, {} tetrahedra, {} duplicates, {} rejected, {:.3f} s, {:.0f} points/s, "
             "peak memory {:.0f} MB{}\n",
    points, mesh.cellCount(), mesh.Duplicates.size(), mesh.Rejected.size(), seconds,
    seconds > 0 ? double(points) / seconds : 0.0, double(peakMemoryBytes()) / 1e6, ranks);
}

namespace
{

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

int runDelaunay3D(const Delaunay3DArguments& arguments)
{
  const PathState before =
    requireWritable(arguments.Output, arguments.Statistics, arguments.Inputs);
  PointTable table = readPoints(arguments.Inputs, arguments.Columns);
  const auto count = std::int64_t(table.size());
  reportLeftOut(table.LeftOut, table.ThinnedOut);
  const std::vector<Point3> points =
    coordinatesOf(table, requireElevation(table, arguments.Inputs.front()));
  if (isInterrupted())
  {
    return reportInterrupt();
  }
  Tetrahedralization mesh;
  Triangulation triangles; // if the points are coplanar
  const Stopwatch watch;
  {
    const auto bar = std::make_unique<ProgressBar>("Tetrahedralizing");
    TetrahedralizationOptions options;
    options.Partitions = arguments.Partitions;
    options.Threads = arguments.Threads;
    options.Progress = progressOn(bar);
    mesh = tetrahedralize(points.data(), points.size(), options);
    if (!mesh.Aborted && mesh.Dimension == 2)
    {
      triangles = triangulateCoplanar(points.data(), points.size(), options, mesh);
      mesh.Aborted = triangles.Aborted;
    }
  }
  const double seconds = watch.seconds();
  if (mesh.Aborted || isInterrupted() ||
    !writeResult(arguments, std::move(table), mesh, triangles, before))
  {
    return reportInterrupt();
  }
  report(arguments, mesh, triangles, count, seconds,
    statisticsOf(mesh, count, std::int64_t(mesh.cellCount())), "");
  for (const std::string& warning : warningsOf(mesh, count))
  {
    fmt::print(stderr, "tipp: warning: {}\n", warning);
  }
  return Success;
}

OutOfCoreStatistics3 makeOutOfCore(const Delaunay3DArguments& arguments)
{
  // With this threshold, large blocks are always returned to the system when they are freed.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  PointOptions columns = arguments.Columns;
  setThinningFile(columns, arguments.Scratch, arguments.Output);
  const auto points = openPointStream(arguments.Inputs, columns);
  OutOfCoreOptions3 options;
  options.MemoryLimit =
    arguments.Memory.empty() ? options.MemoryLimit : *parseMemorySize(arguments.Memory);
  options.Threads = arguments.Threads;
  options.MapDuplicates = arguments.MapDuplicates;
  options.Neighbors = arguments.Neighbors;
  options.Resume = arguments.Resume;
  options.Scratch = arguments.Scratch;
  const std::string title = "Tetrahedralizing";
  auto bar = std::make_unique<ProgressBar>(title);
  options.Progress = progressOn(bar);
  options.Warn = warnAbove(bar, title);
  return tetrahedralizeOutOfCore(*points, arguments.Output, options);
}

int runDelaunay3DOutOfCore(const Delaunay3DArguments& arguments)
{
  checkOutputs(arguments.Output, arguments.Statistics, arguments.Scratch, arguments.Inputs);
  const OutOfCoreStatistics3 made = makeOutOfCore(arguments);
  if (made.Aborted)
  {
    return reportInterruptedRun(made.Kept);
  }
  const double seconds = totalSeconds(made.Phases);
  if (!arguments.Statistics.empty())
  {
    nlohmann::ordered_json json = { { "input", arguments.Inputs }, { "output", arguments.Output },
      { "seconds", seconds }, { "peak_memory_bytes", peakMemoryBytes() } };
    json.update(jsonOf(statisticsOf(made)));
    writeJson(arguments.Statistics, json);
  }
  reportLeftOut(made.LeftOut, made.ThinnedOut);
  fmt::print(
    "{} points, {} tetrahedra, {} duplicates, {} rejected, {} pieces, {:.0f} MB, {:.3f} s, "
    "{:.0f} points/s, peak memory {:.0f} MB\n",
    made.Points, made.Tetrahedra, made.Duplicates, made.Rejected, made.Pieces,
    double(made.MeshBytes) / 1e6, seconds, double(made.Points) / seconds,
    double(peakMemoryBytes()) / 1e6);
  return Success;
}

std::string checkTetrahedronFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".vtu" || extension == ".npy" || extension == ".tipp"
    ? ""
    : "'" + path + "' does not end in .vtu, .npy or .tipp";
}

/// Throws CLI::ValidationError for options that the kind of output does not support.
void requireFitting(const Delaunay3DArguments& arguments)
{
  const std::string extension = extensionOf(arguments.Output);
  const bool isOutOfCore = extension == ".tipp";
  constexpr const char* needsArrays = "needs an output named .vtu or .tipp";
  refuseIf(arguments.Neighbors && extension == ".npy", "--neighbors", needsArrays);
  refuseIf(arguments.MapDuplicates && extension == ".npy", "--map-duplicates", needsArrays);
  refuseIf(arguments.Partitions > 0 && isOutOfCore, "--partitions",
    "needs an output named .vtu or .npy; for .tipp, --memory determines the partitions");
  refuseIf(!arguments.Memory.empty() && !isOutOfCore, "--memory", "needs an output named .tipp");
  refuseIf(arguments.Resume && !isOutOfCore, "--resume", "needs an output named .tipp");
  refuseIf(!arguments.Scratch.empty() && !isOutOfCore, "--scratch", "needs an output named .tipp");
}

} // namespace

void addDelaunay3DCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<Delaunay3DArguments>();
  CLI::App* const command =
    app.add_subcommand("delaunay3d", "Tetrahedralizes points: exact 3D Delaunay, in parallel");
  command->add_option("input", arguments->Inputs, "The points, of one or more files")->required();
  command->add_option("-o,--output", arguments->Output, "The tetrahedra")
    ->required()
    ->check(checkTetrahedronFile);
  addPointOptions(*command, arguments->Columns);
  addThreadsOption(*command, arguments->Threads);
  command
    ->add_option(
      "--partitions", arguments->Partitions, "The number of partitions; 0: chosen automatically")
    ->check(CLI::Range(0, 512))
    ->capture_default_str();
  command->add_flag("--map-duplicates", arguments->MapDuplicates,
    "Add the point array RepresentativePointId: for each point the id of the vertex with its "
    "coordinates, -1 if it is not finite");
  command->add_flag("--neighbors", arguments->Neighbors,
    "Add the cell array NeighborIds: for each corner the id of the tetrahedron opposite to it, -1 "
    "at the hull");
  command->add_option("--stats", arguments->Statistics, "A JSON file for figures of the run");
  command
    ->add_option("--memory", arguments->Memory,
      "With a .tipp output: the memory limit of the process, such as 512M (default: 2G)")
    ->check(checkMemorySize);
  addResumeOptions(*command, "With a .tipp output", arguments->Resume, arguments->Scratch);
  command->footer(footer);
  command->callback(
    [arguments, &exitCode]()
    {
      requireFitting(*arguments);
      arguments->Columns.InSpace = true;
      if (extensionOf(arguments->Output) == ".tipp")
      {
        exitCode = isIdleRank() ? Success : runDelaunay3DOutOfCore(*arguments);
        return;
      }
      const MpiSession session;
      exitCode = session.controller() ? runDelaunay3DOnRanks(*arguments, session.controller())
                                      : runDelaunay3D(*arguments);
    });
}

} // namespace tipp
