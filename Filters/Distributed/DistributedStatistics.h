// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedStatistics_h
#define tippDistributedStatistics_h

#include "Distributed/CellExchange.h"
#include "Ranks/Communicator.h"
#include "Triangulation/Triangulation.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// One rank's statistics. Seconds are wall-clock time, except ComputeSeconds (summed over the
/// rank's threads) and the masters' seconds, which are processor time: it excludes time when
/// another process has the core.
struct RankStatistics
{
  std::int64_t InputPoints = 0;
  std::int64_t OwnedPoints = 0; ///< points that this rank owns
  std::int64_t Triangles = 0;
  std::int64_t Partitions = 0;     ///< triangulated by this rank
  std::int64_t WorkerVertices = 0; ///< vertices triangulated by this rank's workers
  double ExchangeSeconds = 0;      ///< sending points to their owners
  double ComputeSeconds = 0;
  double WaitSeconds = 0;      ///< idle while partitions were triangulated
  double SendSeconds = 0;      ///< time spent in sending messages
  double MasterSeconds = 0;    ///< time as the master of the whole domain
  double SubMasterSeconds = 0; ///< time as the master of major partitions
  double CollectSeconds = 0;   ///< sending boundary triangles to their owners
  double TotalSeconds = 0;
};

/// The statistics of one master, or of the whole domain if the run has no masters.
struct MasterStatistics
{
  std::int32_t Area = 0;        ///< 0: the whole domain; else its first major partition, from 1
  std::int32_t Rank = 0;        ///< the master's rank
  std::int32_t GroupSize = 0;   ///< ranks that worked for it
  std::int64_t LargestMesh = 0; ///< maximum number of triangles in its inboxes
  double Seconds = 0;
  /// For the whole domain: the processor time of the slowest rank between two barriers, summed over
  /// the barriers. It is a lower bound on the computing time with one processor per rank.
  double PathSeconds = 0;
  std::vector<TriangulationStatistics::Stage>
    Stages; ///< stages, one per colour or per start of a partition
};

template <typename Archive>
void serialize(Archive& archive, MasterStatistics& master)
{
  archive(master.Area, master.Rank, master.GroupSize, master.LargestMesh, master.Seconds,
    master.PathSeconds, master.Stages);
}

/// Messages of one kind, summed over all ranks.
struct TrafficStatistics
{
  std::string Kind; ///< name of the message kind
  std::int64_t Messages = 0;
  std::int64_t Bytes = 0;
};

/// The statistics of all ranks.
struct DistributedStatistics
{
  std::vector<RankStatistics> Ranks;     ///< one entry per rank
  std::vector<MasterStatistics> Masters; ///< the first is the whole domain's
  std::vector<TrafficStatistics> Traffic;
  std::int64_t Partitions = 0;
  std::int64_t MajorPartitions = 0; ///< 0: one master
  int ThreadsPerRank = 0;
  double Seconds = 0; ///< wall-clock time of the slowest rank
};

/// Sets all ranks' statistics on all ranks, but not the numbers of partitions. Collective.
void gatherStatistics(Communicator& ranks, RankStatistics own,
  const std::vector<MasterStatistics>& masters, int threads, DistributedStatistics& statistics);

/// Sets the totals over all ranks and their statistics in a rank's part of a triangulation, which
/// has `cells` cells. Collective.
template <typename Mesh>
void setTotals(Communicator& ranks, std::size_t cells, const RankStatistics& own,
  const std::vector<MasterStatistics>& masters, int threads, Mesh& mine)
{
  numberCells(ranks, cells, mine);
  std::vector<std::int64_t> sums{ std::int64_t(mine.Duplicates.size()),
    std::int64_t(mine.Rejected.size()) };
  ranks.sum(sums);
  mine.AllDuplicates = sums[0];
  mine.AllRejected = sums[1];
  gatherStatistics(ranks, own, masters, threads, mine.Statistics);
}

} // namespace tipp

#endif
