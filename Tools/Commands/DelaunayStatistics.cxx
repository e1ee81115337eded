// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/DelaunayStatistics.h"

#include "Commands/PointArguments.h"
#include "Commands/RankStatistics.h"
#include "Commands/Report.h"

#include <fmt/format.h>

namespace tipp
{
namespace
{

double pointsPerSecond(const DelaunayRun& run)
{
  return run.TriangulateSeconds > 0 ? double(run.Points) / run.TriangulateSeconds : 0;
}

nlohmann::ordered_json describeRun(const DelaunayRun& run)
{
  return {
    { "input", run.Input },
    { "output", run.Output },
    { "points", run.Points },
    { "disagreeing_places", run.DisagreeingPlaces },
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
  return fmt::format("{} points, {} triangles, {}{}, {:.3f} s, {:.0f} points/s, peak "
                     "memory {:.0f} MB",
    run.Points, result.triangleCount(),
    describeDuplicates(std::int64_t(result.Duplicates.size()), run.DisagreeingPlaces), rejected,
    run.TriangulateSeconds, pointsPerSecond(run), double(peakMemoryBytes()) / 1e6);
}

void writeStatistics(const std::string& path, const DelaunayRun& run, const Triangulation& result)
{
  const TriangulationStatistics& statistics = result.Statistics;
  nlohmann::ordered_json json = describeRun(run);
  json.update({
    { "triangles", result.triangleCount() },
    { "duplicates", result.Duplicates.size() },
    { "rejected", result.Rejected.size() },
    { "threads", statistics.Threads },
    { "partitions", statistics.Partitions },
    { "initial_points", statistics.InitialPoints },
    { "worker_vertices", statistics.WorkerVertices },
    { "phases", nlohmann::ordered_json::array() },
    { "stages", nlohmann::ordered_json::array() },
  });
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
