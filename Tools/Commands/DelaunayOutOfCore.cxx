// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayOutOfCore.h"

#include "Commands/Commands.h"
#include "Commands/MemorySize.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Interrupt.h"
#include "Console/ProgressBar.h"
#include "Files/Extension.h"
#include "Files/PendingFile.h"
#include "Files/RequireApart.h"
#include "OutOfCore/OutOfCoreRanks.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <numeric>
#include <vector>

#include <malloc.h>

namespace tipp
{
namespace
{

std::unique_ptr<ProgressBar> makeBar()
{
  return std::make_unique<ProgressBar>("Triangulating");
}

OutOfCoreOptions makeOptions(const DelaunayArguments& arguments, std::unique_ptr<ProgressBar>& bar)
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
  options.Neighbors = arguments.Neighbors;
  options.CountOnly = arguments.Sink == "count";
  options.Resume = arguments.Resume;
  options.Scratch = arguments.Scratch;
  options.Progress = [&bar](double fraction)
  {
    if (bar)
    {
      bar->update(fraction);
    }
    return !isInterrupted();
  };
  options.Warn = [&bar](const std::string& sentence)
  {
    bar.reset();
    fmt::print(stderr, "tipp: warning: {}\n", sentence);
    bar = makeBar();
  };
  return options;
}

/// The bytes that the process has read or written so far: "rchar" or "wchar" of Linux's
/// /proc/self/io.
std::int64_t movedBytes(const std::string& name)
{
  std::ifstream file("/proc/self/io");
  std::string label;
  std::int64_t bytes = 0;
  while (file >> label >> bytes)
  {
    if (label == name + ":")
    {
      return bytes;
    }
  }
  return 0;
}

double totalSeconds(const OutOfCoreStatistics& statistics)
{
  double sum = 0;
  for (const OutOfCoreStatistics::Phase& phase : statistics.Phases)
  {
    sum += phase.Seconds;
  }
  return sum;
}

/// A process's resource usage, from /proc and getrusage().
struct ProcessUsage
{
  std::int64_t PeakMemory = peakMemoryBytes();
  std::int64_t Read = movedBytes("rchar");
  std::int64_t Written = movedBytes("wchar");
};

/// Gathers the usage of all ranks on the first.
std::vector<ProcessUsage> gatherUsage(Postbox& ranks)
{
  ByteWriter writer;
  writer.value(ProcessUsage());
  std::vector<ProcessUsage> all;
  for (const Bytes& bytes : ranks.gather(writer.take()))
  {
    all.push_back(ByteReader(bytes).value<ProcessUsage>());
  }
  return all;
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

std::int64_t largestMemory(const std::vector<ProcessUsage>& ranks)
{
  const std::vector<std::int64_t> list = listOf(ranks, &ProcessUsage::PeakMemory);
  return *std::max_element(list.begin(), list.end());
}

void writeReport(const DelaunayArguments& arguments, const OutOfCoreStatistics& statistics,
  const std::vector<ProcessUsage>& ranks)
{
  nlohmann::ordered_json json = {
    { "input", arguments.Inputs },
    { "output", arguments.Output },
    { "points", statistics.Points },
    { "triangles", statistics.Triangles },
    { "triangle_sum", fmt::format("{:016x}", statistics.TriangleSum) },
    { "duplicates", statistics.Duplicates },
    { "rejected", statistics.Rejected },
    { "pieces", statistics.Pieces },
    { "partitions", statistics.Partitions },
    { "worker_vertices", statistics.WorkerVertices },
    { "boundary_bytes", statistics.BoundaryBytes },
    { "spilled_bytes", statistics.SpilledBytes },
    { "mesh_bytes", statistics.MeshBytes },
    { "read_bytes", sumOf(ranks, &ProcessUsage::Read) },
    { "written_bytes", sumOf(ranks, &ProcessUsage::Written) },
    { "resumed", statistics.Resumed },
    { "seconds", totalSeconds(statistics) },
    { "peak_memory_bytes", largestMemory(ranks) },
    { "rank_memory_bytes", listOf(ranks, &ProcessUsage::PeakMemory) },
    { "ranks", ranks.size() },
    { "threads", statistics.Threads },
    { "phases", nlohmann::ordered_json::array() },
  };
  for (const OutOfCoreStatistics::Phase& phase : statistics.Phases)
  {
    json["phases"].push_back({ { "name", phase.Name }, { "seconds", phase.Seconds } });
  }
  writeJson(arguments.Statistics, json);
}

std::string summarize(const OutOfCoreStatistics& statistics, const std::vector<ProcessUsage>& ranks)
{
  const double seconds = totalSeconds(statistics);
  const std::string rejected =
    statistics.Rejected == 0 ? "" : fmt::format(", {} rejected", statistics.Rejected);
  const std::string each = ranks.size() == 1 ? "" : " on a rank at most";
  return fmt::format("{} points, {} triangles, {} duplicates{}, {} pieces, {:.0f} MB, {:.3f} s, "
                     "{:.0f} points/s, peak memory {:.0f} MB{}",
    statistics.Points, statistics.Triangles, statistics.Duplicates, rejected, statistics.Pieces,
    double(statistics.MeshBytes) / 1e6, seconds, double(statistics.Points) / seconds,
    double(largestMemory(ranks)) / 1e6, each);
}

void reportMade(const DelaunayArguments& arguments, const OutOfCoreStatistics& statistics,
  const std::vector<ProcessUsage>& ranks)
{
  if (!arguments.Statistics.empty())
  {
    writeReport(arguments, statistics, ranks);
  }
  reportLeftOut(statistics.LeftOut);
  const bool isCounted = arguments.Sink == "count";
  fmt::print("{}{}\n", summarize(statistics, ranks),
    isCounted ? fmt::format(", checksum {:016x}", statistics.TriangleSum) : "");
  if (statistics.Triangles == 0)
  {
    fmt::print(stderr,
      "tipp: warning: no triangles, since there are fewer than three distinct points or all lie on "
      "one line.\n");
  }
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
  // A fixed threshold: large blocks are always returned to the system when they are freed.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  Postbox ranks(controller);
  const bool isFirst = ranks.rank() == 0;
  OutOfCoreStatistics statistics;
  std::unique_ptr<ProgressBar> bar;
  const auto open = [&]
  {
    if (isFirst)
    {
      requireApart(
        { arguments.Output, arguments.Statistics, scratchIn(arguments.Scratch) }, arguments.Inputs);
      if (!arguments.Statistics.empty())
      {
        // fails early if the file cannot be written
        const PendingFile writable(arguments.Statistics);
      }
      bar = makeBar();
    }
    return openPointStream(arguments.Inputs, arguments.Columns);
  };
  try
  {
    statistics =
      triangulateOutOfCoreOnRanks(ranks, open, arguments.Output, makeOptions(arguments, bar));
  }
  catch (const RankFailure& failure)
  {
    bar.reset();
    if (isFirst)
    {
      fmt::print(stderr, "tipp: {}{}\n",
        ranks.size() > 1 ? fmt::format("rank {}: ", failure.Rank) : "", failure.what());
    }
    return Failure;
  }
  bar.reset();
  if (statistics.Aborted)
  {
    return reportInterrupt(
      statistics.Kept ? "the same command with --resume goes on" : "nothing was written");
  }
  const std::vector<ProcessUsage> usage = gatherUsage(ranks);
  if (isFirst)
  {
    reportMade(arguments, statistics, usage);
  }
  return Success;
}

} // namespace tipp
