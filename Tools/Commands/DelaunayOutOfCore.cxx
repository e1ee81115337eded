// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayRuns.h"

#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Constraints/OnDisk/ConstrainedPoints.h"

#include <fmt/format.h>

#include <numeric>
#include <vector>

namespace tipp
{
namespace
{

OutOfCoreOptions makeOptions(const DelaunayArguments& arguments)
{
  const GridSize grid = *parseGrid(arguments.Partitions);
  OutOfCoreOptions options;
  if (!arguments.Memory.empty())
  {
    options.MemoryLimit = *parseMemorySize(arguments.Memory);
  }
  options.Columns = grid.Columns;
  options.Rows = grid.Rows;
  options.Threads = arguments.Threads;
  options.MaximumEdge = arguments.MaximumEdge;
  options.MapDuplicates = arguments.MapDuplicates;
  options.Duplicates = arguments.Duplicates;
  options.Neighbors = arguments.Neighbors;
  options.MarkConstraints = arguments.MarkConstraints;
  options.CountOnly = arguments.Sink == "count";
  options.Resume = arguments.Resume;
  options.Scratch = arguments.Scratch;
  return options;
}

std::vector<std::int64_t> listOf(
  const std::vector<ProcessUsage>& ranks, std::int64_t ProcessUsage::*value)
{
  std::vector<std::int64_t> list;
  list.reserve(ranks.size());
  for (const ProcessUsage& usage : ranks)
  {
    list.push_back(usage.*value);
  }
  return list;
}

std::int64_t sumOf(const std::vector<ProcessUsage>& ranks, std::int64_t ProcessUsage::*value)
{
  const std::vector<std::int64_t> list = listOf(ranks, value);
  return std::accumulate(list.begin(), list.end(), std::int64_t(0));
}

void reportMade(const DelaunayArguments& arguments, const OutOfCoreStatistics& statistics,
  const std::vector<ProcessUsage>& ranks)
{
  const bool isCounted = arguments.Sink == "count";
  const double seconds = totalSeconds(statistics.Phases);
  nlohmann::ordered_json json = { { "input", arguments.Inputs }, { "output", arguments.Output } };
  json.update(jsonOf(statisticsOf(statistics, isCounted)));
  json.update({
    { "read_bytes", sumOf(ranks, &ProcessUsage::Read) },
    { "written_bytes", sumOf(ranks, &ProcessUsage::Written) },
    { "seconds", seconds },
    { "peak_memory_bytes", largestMemory(ranks) },
    { "rank_memory_bytes", listOf(ranks, &ProcessUsage::PeakMemory) },
    { "ranks", ranks.size() },
  });
  reportLeftOut(statistics.LeftOut, statistics.ThinnedOut);
  reportRun(arguments.Statistics, json, seconds,
    std::string(ranks.size() == 1 ? "" : " of the largest rank") +
      (isCounted ? fmt::format(", checksum {:016x}", statistics.TriangleSum) : ""));
  if (statistics.Constraints.Constraints > 0)
  {
    fmt::print("{}\n", describeSegments(statistics.Constraints));
  }
  warnOfNoTriangles(statistics.Triangles);
}

} // namespace

int runDelaunayOutOfCore(const DelaunayArguments& arguments, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  const OutOfCoreOptions options = makeOptions(arguments);
  const auto open = [&]
  {
    if (ranks.rank() == 0)
    {
      checkOutputs(arguments.Output, arguments.Statistics, arguments.Scratch, arguments.Inputs);
    }
    return joinConstraints(openPointStream(arguments.Inputs, withThinningFile(arguments)),
      arguments.Constraints, options);
  };
  OutOfCoreStatistics statistics;
  const int code =
    runOutOfCore(ranks, "Triangulating", open, arguments.Output, options, statistics);
  if (code != Success)
  {
    return code;
  }
  const std::vector<ProcessUsage> usage = gatherUsage(ranks);
  if (ranks.rank() == 0)
  {
    reportMade(arguments, statistics, usage);
  }
  return Success;
}

} // namespace tipp
