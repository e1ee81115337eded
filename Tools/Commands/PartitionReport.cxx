// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/PartitionReport.h"

#include "Commands/Report.h"

#include <fmt/format.h>

namespace tipp
{
namespace
{

double totalSeconds(const PartitionStatistics& statistics)
{
  double sum = 0;
  for (const PartitionStatistics::Phase& phase : statistics.Phases)
  {
    sum += phase.Seconds;
  }
  return sum;
}

} // namespace

std::string summarize(const PartitionStatistics& statistics)
{
  return fmt::format("{} cells, {} points, {} pieces, {} borrowed cells, {:.0f} MB, {:.3f} s, peak "
                     "memory {:.0f} MB",
    statistics.Cells, statistics.Points, statistics.Pieces, statistics.BorrowedCells,
    double(statistics.MeshBytes) / 1e6, totalSeconds(statistics), double(peakMemoryBytes()) / 1e6);
}

void writeReport(const std::string& path, const std::string& input, const std::string& output,
  const PartitionStatistics& statistics)
{
  const LoadCounters& loads = statistics.Loads;
  nlohmann::ordered_json json = {
    { "input", input },
    { "output", output },
    { "points", statistics.Points },
    { "cells", statistics.Cells },
    { "pieces", statistics.Pieces },
    { "border_cells", statistics.BorderCells },
    { "borrowed_cells", statistics.BorrowedCells },
    { "copied_points", statistics.CopiedPoints },
    { "spilled_bytes", statistics.SpilledBytes },
    { "mesh_bytes", statistics.MeshBytes },
    { "seconds", totalSeconds(statistics) },
    { "peak_memory_bytes", peakMemoryBytes() },
    { "ranks", statistics.Ranks },
    { "threads", statistics.Threads },
    { "loader", statistics.Loader },
    { "loads",
      { { "reads", loads.Reads }, { "bytes", loads.Bytes }, { "useful_bytes", loads.UsefulBytes },
        { "passes", loads.Passes }, { "cache_misses", loads.CacheMisses } } },
    { "phases", nlohmann::ordered_json::array() },
  };
  for (const PartitionStatistics::Phase& phase : statistics.Phases)
  {
    json["phases"].push_back({ { "name", phase.Name }, { "seconds", phase.Seconds } });
  }
  writeJson(path, json);
}

} // namespace tipp
