// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/RankStatistics.h"

namespace tipp
{

nlohmann::ordered_json describe(const DistributedStatistics& statistics)
{
  nlohmann::ordered_json json = {
    { "seconds", statistics.Seconds },
    { "threads_per_rank", statistics.ThreadsPerRank },
    { "partitions", statistics.Partitions },
    { "major_partitions", statistics.MajorPartitions },
    { "ranks", nlohmann::ordered_json::array() },
    { "masters", nlohmann::ordered_json::array() },
    { "traffic", nlohmann::ordered_json::array() },
  };
  for (const RankStatistics& rank : statistics.Ranks)
  {
    json["ranks"].push_back({ { "input_points", rank.InputPoints },
      { "owned_points", rank.OwnedPoints }, { "triangles", rank.Triangles },
      { "partitions", rank.Partitions }, { "worker_vertices", rank.WorkerVertices },
      { "exchange_seconds", rank.ExchangeSeconds }, { "compute_seconds", rank.ComputeSeconds },
      { "wait_seconds", rank.WaitSeconds }, { "send_seconds", rank.SendSeconds },
      { "master_seconds", rank.MasterSeconds }, { "sub_master_seconds", rank.SubMasterSeconds },
      { "collect_seconds", rank.CollectSeconds }, { "total_seconds", rank.TotalSeconds } });
  }
  for (const MasterStatistics& master : statistics.Masters)
  {
    nlohmann::ordered_json stages = nlohmann::ordered_json::array();
    for (const TriangulationStatistics::Stage& stage : master.Stages)
    {
      stages.push_back({ { "active_partitions", stage.ActivePartitions },
        { "mesh_triangles", stage.MeshTriangles } });
    }
    json["masters"].push_back(
      { { "area", master.Area }, { "rank", master.Rank }, { "group_size", master.GroupSize },
        { "largest_mesh", master.LargestMesh }, { "seconds", master.Seconds },
        { "path_seconds", master.PathSeconds }, { "stages", stages } });
  }
  for (const TrafficStatistics& traffic : statistics.Traffic)
  {
    json["traffic"].push_back(
      { { "kind", traffic.Kind }, { "messages", traffic.Messages }, { "bytes", traffic.Bytes } });
  }
  return json;
}

} // namespace tipp
