// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayOutOfCore.h"

#include "Commands/Commands.h"
#include "Commands/MemorySize.h"
#include "Commands/Report.h"
#include "Console/Interrupt.h"
#include "Console/ProgressBar.h"
#include "Files/Extension.h"
#include "Files/PendingFile.h"
#include "OutOfCore/OutOfCoreTriangulation.h"

#include <fmt/format.h>

#include <fstream>

#include <malloc.h>

namespace tipp
{
namespace
{

OutOfCoreOptions makeOptions(const DelaunayArguments& arguments, ProgressBar& bar)
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
  options.MapDuplicates = arguments.MapDuplicates;
  options.CountOnly = arguments.Sink == "count";
  options.Resume = arguments.Resume;
  options.Scratch = arguments.Scratch;
  options.Progress = [&bar](double fraction)
  {
    bar.update(fraction);
    return !isInterrupted();
  };
  return options;
}

/// What the process has read and written so far, in bytes: "rchar" and "wchar" of Linux's
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

void writeReport(const DelaunayArguments& arguments, const OutOfCoreStatistics& statistics)
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
    { "peak_rim_triangles", statistics.PeakRimTriangles },
    { "peak_border_bytes", statistics.PeakBorderBytes },
    { "spilled_bytes", statistics.SpilledBytes },
    { "mesh_bytes", statistics.MeshBytes },
    { "read_bytes", movedBytes("rchar") },
    { "written_bytes", movedBytes("wchar") },
    { "resumed", statistics.Resumed },
    { "seconds", totalSeconds(statistics) },
    { "peak_memory_bytes", peakMemoryBytes() },
    { "threads", statistics.Threads },
    { "phases", nlohmann::ordered_json::array() },
  };
  for (const OutOfCoreStatistics::Phase& phase : statistics.Phases)
  {
    json["phases"].push_back({ { "name", phase.Name }, { "seconds", phase.Seconds } });
  }
  writeJson(arguments.Statistics, json);
}

std::string summarize(const OutOfCoreStatistics& statistics)
{
  const double seconds = totalSeconds(statistics);
  const std::string rejected =
    statistics.Rejected == 0 ? "" : fmt::format(", {} rejected", statistics.Rejected);
  return fmt::format("{} points, {} triangles, {} duplicates{}, {} pieces, {:.0f} MB, {:.3f} s, "
                     "{:.0f} points/s, peak memory {:.0f} MB",
    statistics.Points, statistics.Triangles, statistics.Duplicates, rejected, statistics.Pieces,
    double(statistics.MeshBytes) / 1e6, seconds, double(statistics.Points) / seconds,
    double(peakMemoryBytes()) / 1e6);
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
    : arguments.Inputs.size() > 1  ? "several inputs"
                                   : "";
}

int runDelaunayOutOfCore(const DelaunayArguments& arguments)
{
  if (!arguments.Statistics.empty())
  {
    const PendingFile writable(arguments.Statistics); // before the work rather than after it
  }
  // Large blocks go back to the system when they are freed, whatever was freed before.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  OutOfCoreStatistics statistics;
  {
    const auto points = openPointStream(arguments.Inputs, arguments.Columns);
    ProgressBar bar("Triangulating");
    statistics = triangulateOutOfCore(*points, arguments.Output, makeOptions(arguments, bar));
  }
  if (statistics.Aborted)
  {
    fmt::print(stderr, "tipp: interrupted; {}.\n",
      statistics.Kept ? "the same command with --resume goes on" : "nothing was written");
    return interruptedExitCode;
  }
  if (!arguments.Statistics.empty())
  {
    writeReport(arguments, statistics);
  }
  const bool isCounted = arguments.Sink == "count";
  fmt::print("{}{}\n", summarize(statistics),
    isCounted ? fmt::format(", checksum {:016x}", statistics.TriangleSum) : "");
  if (statistics.Triangles == 0)
  {
    fmt::print(stderr,
      "tipp: warning: no triangles, since there are fewer than three distinct points or all lie on "
      "one line.\n");
  }
  return Success;
}

} // namespace tipp
