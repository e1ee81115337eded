// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayRuns.h"

#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Constraints/ConstrainedPoints.h"
#include "Files/InputFile.h"

#include <fmt/format.h>

#include <algorithm>
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

void writeReport(const DelaunayArguments& arguments, const RunStatistics& statistics,
  double seconds, const std::vector<ProcessUsage>& ranks)
{
  const nlohmann::ordered_json usage = {
    { "read_bytes", sumOf(ranks, &ProcessUsage::Read) },
    { "written_bytes", sumOf(ranks, &ProcessUsage::Written) },
    { "seconds", seconds },
    { "peak_memory_bytes", largestMemory(ranks) },
    { "rank_memory_bytes", listOf(ranks, &ProcessUsage::PeakMemory) },
    { "ranks", ranks.size() },
  };
  nlohmann::ordered_json json = { { "input", arguments.Inputs }, { "output", arguments.Output } };
  json.update(jsonOf(statistics));
  json.update(usage);
  writeJson(arguments.Statistics, json);
}

std::string summarize(const OutOfCoreStatistics& statistics, const std::vector<ProcessUsage>& ranks)
{
  const double seconds = totalSeconds(statistics.Phases);
  const std::string rejected =
    statistics.Rejected == 0 ? "" : fmt::format(", {} rejected", statistics.Rejected);
  const std::string each = ranks.size() == 1 ? "" : " of the largest rank";
  return fmt::format("{} points, {} triangles, {}{}, {} pieces, {:.0f} MB, {:.3f} s, "
                     "{:.0f} points/s, peak memory {:.0f} MB{}",
    statistics.Points, statistics.Triangles,
    describeDuplicates(statistics.Duplicates, statistics.DisagreeingPositions), rejected,
    statistics.Pieces, double(statistics.MeshBytes) / 1e6, seconds,
    double(statistics.Points) / seconds, double(largestMemory(ranks)) / 1e6, each);
}

void reportMade(const DelaunayArguments& arguments, const OutOfCoreStatistics& statistics,
  const ConstraintFigures& constraints, const std::vector<ProcessUsage>& ranks)
{
  const bool isCounted = arguments.Sink == "count";
  // The constraints are not read when a run is resumed.
  const bool hasConstraints = constraints.Constraints > 0;
  if (!arguments.Statistics.empty())
  {
    RunStatistics all = statisticsOf(statistics, isCounted);
    hasConstraints ? addConstraintTotals(constraints, all) : void();
    writeReport(arguments, all, totalSeconds(statistics.Phases), ranks);
  }
  reportLeftOut(statistics.LeftOut, statistics.ThinnedOut);
  fmt::print("{}{}\n", summarize(statistics, ranks),
    isCounted ? fmt::format(", checksum {:016x}", statistics.TriangleSum) : "");
  if (hasConstraints)
  {
    fmt::print("{}\n", describeSegments(constraints));
  }
  warnOfNoTriangles(statistics.Triangles);
}

} // namespace

bool isOutOfCore(const DelaunayArguments& arguments)
{
  return extensionOf(arguments.Output) == ".tipp";
}

std::string misplacedOutOfCoreOption(const DelaunayArguments& arguments)
{
  return !arguments.Memory.empty() ? "--memory"
    : arguments.Sink != "mesh"     ? "--sink"
    : arguments.Resume             ? "--resume"
    : !arguments.Scratch.empty()   ? "--scratch"
                                   : "";
}

int runDelaunayOutOfCore(const DelaunayArguments& arguments, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  OutOfCoreOptions options = makeOptions(arguments);
  ConstrainedInput constraints(arguments.Constraints, arguments.Threads);
  constraints.describe(options);
  const auto open = [&]() -> std::unique_ptr<PointStream>
  {
    if (ranks.rank() == 0)
    {
      checkOutputs(arguments.Output, arguments.Statistics, arguments.Scratch, arguments.Inputs);
    }
    PointOptions points = arguments.Columns;
    setThinningFile(points, arguments.Scratch, arguments.Output);
    return constraints.join(openPointStream(arguments.Inputs, points));
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
    reportMade(arguments, statistics, constraints.figures(), usage);
  }
  return Success;
}

} // namespace tipp
