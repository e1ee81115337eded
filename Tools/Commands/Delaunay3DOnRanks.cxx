// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Delaunay3DRuns.h"

#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Distributed3D/DistributedTetrahedralization.h"
#include "Files/InputFile.h"
#include "Meshes/MeshFiles.h"
#include "Parallel/Stopwatch.h"
#include "Ranks/Communicator.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace tipp
{
namespace
{

/// Returns this rank's share of the points.
std::vector<Point3> readShare(const Communicator& ranks, const Delaunay3DArguments& arguments)
{
  const PointTable table =
    readPointsShare(arguments.Inputs, arguments.Columns, ranks.rank(), ranks.size());
  if (ranks.isFirst()) // it counts the points of all files
  {
    reportLeftOut(table.LeftOut, table.ThinnedOut);
  }
  return table.size() == 0 && !ranks.isFirst()
    ? std::vector<Point3>()
    : coordinatesOf(table, requireElevation(table, arguments.Inputs.front()));
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
  PointTable table = extensionOf(arguments.Output) == ".npy" && all.Dimension != 2
    ? PointTable()
    : readPoints(arguments.Inputs, arguments.Columns);
  if (!writeResult(arguments, std::move(table), all, triangles, before))
  {
    throw RankFailure(0, true, "interrupted");
  }
  report(arguments, all, triangles, mine.AllPoints, seconds, statisticsOf(mine),
    fmt::format(", {} ranks of {} threads", ranks.size(), mine.Statistics.ThreadsPerRank));
  for (const std::string& warning : warningsOf(mine))
  {
    fmt::print(stderr, "tipp: warning: {}\n", warning);
  }
}

void triangulateShares(Communicator& ranks, const Delaunay3DArguments& arguments)
{
  const PathState before = ranks.isFirst()
    ? requireWritable(arguments.Output, arguments.Statistics, arguments.Inputs)
    : PathState();
  const std::vector<Point3> own = readShare(ranks, arguments);
  ranks.barrier();
  const Stopwatch watch;
  RankPoints3 points;
  points.Points = own.data();
  points.Count = own.size();
  auto bar = ranks.isFirst() ? std::make_unique<ProgressBar>("Tetrahedralizing") : nullptr;
  TetrahedralizationOptions options;
  options.Partitions = arguments.Partitions;
  options.Threads = arguments.Threads;
  options.Progress = progressOn(bar);
  const DistributedTetrahedralization mine = tetrahedralizeDistributed(ranks, points, options);
  bar.reset();
  writeOnFirst(ranks, arguments, mine, watch.seconds(), before);
}

} // namespace

int runDelaunay3DOnRanks(
  const Delaunay3DArguments& arguments, vtkMultiProcessController* controller)
{
  return runTogether(controller, [&](Communicator& ranks) { triangulateShares(ranks, arguments); });
}

} // namespace tipp
