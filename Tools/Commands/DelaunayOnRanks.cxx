// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayArguments.h"

#include "Commands/Commands.h"
#include "Commands/DelaunayOutput.h"
#include "Commands/Report.h"
#include "Console/ProgressBar.h"
#include "Console/Signals.h"
#include "Distributed/DistributedTriangulation.h"
#include "Files/InputFile.h"
#include "Parallel/Stopwatch.h"
#include "Ranks/Communicator.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace tipp
{
namespace
{

/// Gathers all ranks' triangles and duplicates, by global ids, on the first rank.
Triangulation gatherTriangles(Communicator& ranks, const DistributedTriangulation& mine)
{
  const std::int64_t own = std::int64_t(mine.Owned.size());
  Bytes ids(mine.triangleCount() * 3 * sizeof(std::int64_t));
  const auto fill = [&](const auto& indices)
  {
    auto* to = reinterpret_cast<std::int64_t*>(ids.data());
    for (const std::int64_t index : indices)
    {
      *to++ = index < own ? mine.Owned.GlobalIds[std::size_t(index)]
                          : mine.Foreign.GlobalIds[std::size_t(index - own)];
    }
  };
  mine.Ids32.empty() ? fill(mine.Ids64) : fill(mine.Ids32);
  const std::vector<Bytes> all = ranks.gather(std::move(ids));
  Triangulation result;
  result.Ids64 = Buffer<std::int64_t>(ranks.rank() == 0 ? std::size_t(3 * mine.AllTriangles) : 0);
  auto* to = reinterpret_cast<char*>(result.Ids64.data());
  for (const Bytes& part : all)
  {
    to = std::copy(part.begin(), part.end(), to);
  }
  for (const std::vector<Duplicate>& part : ranks.gather(mine.Duplicates))
  {
    result.Duplicates.insert(result.Duplicates.end(), part.begin(), part.end());
  }
  for (const std::vector<PointId>& part : ranks.gather(mine.Rejected))
  {
    result.Rejected.insert(result.Rejected.end(), part.begin(), part.end());
  }
  std::sort(result.Duplicates.begin(), result.Duplicates.end(),
    [](const Duplicate& a, const Duplicate& b) { return a.Point < b.Point; });
  return result;
}

/// The first rank writes the file, completely or not at all; the others wait for its outcome.
void writeOnFirst(Communicator& ranks, const DelaunayArguments& arguments, DelaunayRun& run,
  const DistributedTriangulation& mine, const PathState& before)
{
  const Triangulation all = gatherTriangles(ranks, mine);
  if (ranks.rank() != 0)
  {
    return;
  }
  Stopwatch watch;
  // An output of triangles alone has no use for them.
  PointTable points =
    extensionOf(arguments.Output) == ".npy" ? PointTable() : readPointsFor(arguments);
  run.DisagreeingPlaces = resolveDuplicates(points, all.Duplicates, arguments.Duplicates);
  if (!writeResult(arguments, points, all, before))
  {
    throw RankFailure(0, true, "interrupted");
  }
  run.WriteSeconds = watch.restart();
  if (!arguments.Statistics.empty())
  {
    writeStatistics(arguments.Statistics, run, mine);
  }
  fmt::print("{}\n", summarize(run, all, mine.Statistics));
  warnOfNoTriangles(mine.AllTriangles);
}

void runTogether(Communicator& ranks, const DelaunayArguments& arguments)
{
  if (arguments.MaximumEdge > 0)
  {
    throw std::runtime_error("--max-edge needs one rank, or an output named .tipp.");
  }
  const PathState before = ranks.rank() == 0 ? requireWritable(arguments) : PathState();
  DelaunayRun run;
  run.Input = arguments.Input;
  run.Output = arguments.Output;
  Stopwatch watch;
  const PointTable points =
    readPointsShare(arguments.Inputs, arguments.Columns, ranks.rank(), ranks.size());
  ranks.barrier();
  run.ReadSeconds = watch.restart();
  RankPoints input;
  input.Points = PointsView(points.XY.data(), points.size(), 2);
  DistributedOptions options = makeDistributedOptions(arguments);
  std::unique_ptr<ProgressBar> bar;
  if (ranks.rank() == 0)
  {
    bar = std::make_unique<ProgressBar>("Triangulating");
  }
  options.Progress = [&bar](double fraction)
  {
    if (bar)
    {
      bar->update(fraction);
    }
    return !isInterrupted();
  };
  const DistributedTriangulation mine = triangulateDistributed(ranks, input, options);
  bar.reset();
  run.Points = mine.AllPoints;
  run.TriangulateSeconds = watch.restart();
  writeOnFirst(ranks, arguments, run, mine, before);
}

} // namespace

int runDelaunayOnRanks(const DelaunayArguments& arguments, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  try
  {
    ranks.together([&]() { runTogether(ranks, arguments); });
  }
  catch (const RankFailure& failure)
  {
    if (failure.Aborted)
    {
      return reportInterrupt();
    }
    if (ranks.rank() == 0)
    {
      fmt::print(stderr, "tipp: {}{}\n",
        ranks.size() > 1 ? fmt::format("rank {}: ", failure.Rank) : "", failure.what());
    }
    return Failure;
  }
  return Success;
}

} // namespace tipp
