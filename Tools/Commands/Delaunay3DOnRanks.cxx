// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Delaunay3DRuns.h"

#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Distributed3D/DistributedTetrahedralization.h"
#include "Files/InputFile.h"
#include "Meshes/TetrahedronFiles.h"
#include "Parallel/Stopwatch.h"
#include "Ranks/Communicator.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace tipp
{
namespace
{

/// This rank's share of the points.
std::vector<Point3> readShare(const Communicator& ranks, const Delaunay3DArguments& arguments)
{
  const PointTable table =
    readPointsShare(arguments.Inputs, arguments.Columns, ranks.rank(), ranks.size());
  if (ranks.isFirst()) // which counts those of all files
  {
    reportLeftOut(table.LeftOut, table.ThinnedOut);
  }
  return table.size() == 0 && !ranks.isFirst()
    ? std::vector<Point3>()
    : coordinatesOf(table, requireElevation(table, arguments.Inputs.front()));
}

/// The first rank writes the file, completely or not at all; the others wait for its outcome.
void writeOnFirst(Communicator& ranks, const Delaunay3DArguments& arguments,
  const DistributedTetrahedralization& mine, double seconds, const PathState& before)
{
  const Tetrahedralization all = gatherTetrahedra(ranks, mine, arguments.Threads);
  if (!ranks.isFirst())
  {
    return;
  }
  // An output of tetrahedra alone has no use for the points.
  PointTable table = extensionOf(arguments.Output) == ".npy"
    ? PointTable()
    : readPoints(arguments.Inputs, arguments.Columns);
  if (!writeResult(arguments, std::move(table), all, before))
  {
    throw RankFailure(0, true, "interrupted");
  }
  report(arguments, all, mine.AllPoints, seconds, jsonOf(statisticsOf(mine)),
    fmt::format(", {} ranks of {} threads", ranks.size(), mine.Statistics.ThreadsPerRank));
  for (const std::string& warning : warningsOf(mine))
  {
    fmt::print(stderr, "tipp: warning: {}\n", warning);
  }
}

void runTogether(Communicator& ranks, const Delaunay3DArguments& arguments)
{
  const PathState before = ranks.isFirst() ? requireWritable(arguments) : PathState();
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
  Communicator ranks(controller);
  try
  {
    ranks.together([&]() { runTogether(ranks, arguments); });
  }
  catch (const RankFailure& failure)
  {
    return failure.Aborted ? reportInterrupt() : reportRankFailure(failure, ranks);
  }
  return Success;
}

} // namespace tipp
