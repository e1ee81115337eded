// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayStatistics.h"

#include "Commands/MemorySize.h"
#include "Commands/RankStatistics.h"

#include "Files/IOError.h"
#include "Files/PendingFile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace tipp
{
namespace
{

double pointsPerSecond(const DelaunayRun& run)
{
  return run.TriangulateSeconds > 0 ? double(run.Points) / run.TriangulateSeconds : 0;
}

void writeJson(const std::string& path, const nlohmann::ordered_json& json)
{
  PendingFile pending(path);
  std::ofstream file(pending.temporaryPath());
  // File names need not be UTF-8.
  file << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  file.close();
  if (!file)
  {
    throw IOError(path, "cannot be written; check the disk's space and the folder's permissions.");
  }
  pending.commit();
}

nlohmann::ordered_json describeRun(const DelaunayRun& run)
{
  return {
    { "input", run.Input },
    { "output", run.Output },
    { "points", run.Points },
    { "read_seconds", run.ReadSeconds },
    { "triangulate_seconds", run.TriangulateSeconds },
    { "write_seconds", run.WriteSeconds },
    { "points_per_second", pointsPerSecond(run) },
    { "peak_memory_bytes", peakMemoryBytes() },
  };
}

} // namespace

std::string summarize(const DelaunayRun& run, const Triangulation& result)
{
  const std::string rejected =
    result.Rejected.empty() ? "" : fmt::format(", {} rejected", result.Rejected.size());
  return fmt::format("{} points, {} triangles, {} duplicates{}, {:.3f} s, {:.0f} points/s, peak "
                     "memory {:.0f} MB",
    run.Points, result.triangleCount(), result.Duplicates.size(), rejected, run.TriangulateSeconds,
    pointsPerSecond(run), double(peakMemoryBytes()) / 1e6);
}

void writeStatistics(const std::string& path, const DelaunayRun& run, const Triangulation& result)
{
  const TriangulationStatistics& statistics = result.Statistics;
  nlohmann::ordered_json json = {
    { "input", run.Input },
    { "output", run.Output },
    { "points", run.Points },
    { "triangles", result.triangleCount() },
    { "duplicates", result.Duplicates.size() },
    { "rejected", result.Rejected.size() },
    { "read_seconds", run.ReadSeconds },
    { "triangulate_seconds", run.TriangulateSeconds },
    { "write_seconds", run.WriteSeconds },
    { "points_per_second", pointsPerSecond(run) },
    { "peak_memory_bytes", peakMemoryBytes() },
    { "threads", statistics.Threads },
    { "partitions", statistics.Partitions },
    { "initial_points", statistics.InitialPoints },
    { "worker_vertices", statistics.WorkerVertices },
    { "phases", nlohmann::ordered_json::array() },
    { "stages", nlohmann::ordered_json::array() },
  };
  for (const TriangulationStatistics::Phase& phase : statistics.Phases)
  {
    json["phases"].push_back({ { "name", phase.Name }, { "seconds", phase.Seconds } });
  }
  for (const TriangulationStatistics::Stage& stage : statistics.Stages)
  {
    json["stages"].push_back({ { "active_partitions", stage.ActivePartitions },
      { "mesh_triangles", stage.MeshTriangles } });
  }
  writeJson(path, json);
}

std::string summarize(
  const DelaunayRun& run, const Triangulation& all, const DistributedStatistics& statistics)
{
  return fmt::format("{}, {} ranks of {} threads", summarize(run, all), statistics.Ranks.size(),
    statistics.ThreadsPerRank);
}

void writeStatistics(
  const std::string& path, const DelaunayRun& run, const DistributedTriangulation& result)
{
  nlohmann::ordered_json json = describeRun(run);
  json["triangles"] = result.AllTriangles;
  json["duplicates"] = result.AllDuplicates;
  json["rejected"] = result.AllRejected;
  json.update(describe(result.Statistics));
  writeJson(path, json);
}

} // namespace tipp
