// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedStatistics_h
#define tippDistributedStatistics_h

#include "Ranks/Communicator.h"
#include "Triangulation/Triangulate.h"

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
  std::int64_t OwnedPoints = 0;
  std::int64_t Triangles = 0;
  std::int64_t Partitions = 0; ///< triangulated by this rank
  std::int64_t WorkerVertices = 0;
  double ExchangeSeconds = 0; ///< sending points to their owners
  double ComputeSeconds = 0;
  double WaitSeconds = 0; ///< idle while partitions were triangulated
  double SendSeconds = 0;
  double MasterSeconds = 0;    ///< as the master of the whole domain
  double SubMasterSeconds = 0; ///< as the master of major partitions
  double CollectSeconds = 0;   ///< sending boundary triangles to their owners
  double TotalSeconds = 0;
};

/// A master's statistics; without masters, those of the whole domain.
struct MasterStatistics
{
  std::int32_t Area = 0; ///< 0: the whole domain; else its first major partition, from 1
  std::int32_t Rank = 0;
  std::int32_t GroupSize = 0;   ///< ranks that worked for it
  std::int64_t LargestMesh = 0; ///< maximum number of triangles in its inboxes
  double Seconds = 0;
  /// For the whole domain: the processor time of the slowest rank between two barriers, summed over
  /// the barriers. It is a lower bound on the computing time with one processor per rank.
  double PathSeconds = 0;
  std::vector<TriangulationStatistics::Stage> Stages; ///< by colour, or by start of a partition
};

/// Messages of one kind, summed over all ranks.
struct TrafficStatistics
{
  std::string Kind;
  std::int64_t Messages = 0;
  std::int64_t Bytes = 0;
};

/// The statistics of all ranks.
struct DistributedStatistics
{
  std::vector<RankStatistics> Ranks;     ///< by rank
  std::vector<MasterStatistics> Masters; ///< the first is the whole domain's
  std::vector<TrafficStatistics> Traffic;
  std::int64_t Partitions = 0;
  std::int64_t MajorPartitions = 0; ///< 0: one master
  int ThreadsPerRank = 0;
  double Seconds = 0; ///< of the slowest rank
};

/// Gathers all ranks' statistics on all ranks. Collective.
DistributedStatistics gatherStatistics(
  Communicator& ranks, const RankStatistics& own, const std::vector<MasterStatistics>& masters);

} // namespace tipp

#endif
