// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayRuns.h"

#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Console/ProgressBar.h"
#include "Constraints/OnDisk/ConstrainedPoints.h"
#include "Distributed/TriangleExchange.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TemporaryFiles.h"
#include "Parallel/Stopwatch.h"
#include "Points/PointStream.h"
#include "Ranks/Communicator.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace tipp
{
namespace
{

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
  reportRun(arguments, run, json,
    fmt::format(", {} ranks of {} threads", statistics.Ranks.size(), statistics.ThreadsPerRank));
  if (constraints.Segments)
  {
    fmt::print("{}\n", describeSegments(constraints.Figures));
  }
  warnOfNoTriangles(mine.AllCells);
}

void triangulateShares(Communicator& ranks, const DelaunayArguments& arguments)
{
  if (arguments.MaximumEdge > 0)
  {
    throw std::runtime_error("--max-edge needs one rank, or an output named .tipp.");
  }
  const PathState before = ranks.rank() == 0 ? requireWritable(arguments) : PathState();
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
  if (ranks.isFirst()) // it counts the points of all files
  {
    reportLeftOut(points.LeftOut, points.ThinnedOut);
  }
  RankPoints input;
  input.Points = PointsView(points.XY.data(), points.size(), 2);
  DistributedOptions options = makeDistributedOptions(arguments);
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

} // namespace

int runDelaunayOnRanks(const DelaunayArguments& arguments, vtkMultiProcessController* controller)
{
  return runTogether(controller, [&](Communicator& ranks) { triangulateShares(ranks, arguments); });
}

} // namespace tipp
