// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedStatistics_h
#define tippDistributedStatistics_h

#include "Messages/Postbox.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// What a rank did. Seconds are wall clock; those of computing, summed over its threads, and of
/// masters are processor time, which does not count when others have the core.
struct RankStatistics
{
  std::int64_t InputPoints = 0;
  std::int64_t OwnedPoints = 0;
  std::int64_t Triangles = 0;
  std::int64_t Partitions = 0; ///< that this rank triangulated
  std::int64_t WorkerVertices = 0;
  double ExchangeSeconds = 0; ///< bringing points to their owners
  double ComputeSeconds = 0;
  double WaitSeconds = 0; ///< with nothing to compute, while partitions were triangulated
  double SendSeconds = 0;
  double MasterSeconds = 0;    ///< as the master of the whole domain
  double SubMasterSeconds = 0; ///< as that of major partitions
  double CollectSeconds = 0;   ///< bringing boundary triangles to their ranks
  double TotalSeconds = 0;
};

/// What a master did, or, without one, what is known of the whole domain.
struct MasterStatistics
{
  std::int32_t Area = 0; ///< 0: the whole domain; else the first of its major partitions, from 1
  std::int32_t Rank = 0;
  std::int32_t GroupSize = 0;   ///< ranks that worked for it
  std::int64_t LargestMesh = 0; ///< most triangles in the inboxes that it kept
  double Seconds = 0;
  /// Of the whole domain: processor time of the rank that computes longest between two barriers,
  /// summed over these: what computing takes at least where each rank has a processor.
  double PathSeconds = 0;
  std::vector<TriangulationStatistics::Stage> Stages; ///< by colour, or by partition started
};

/// Sent between ranks, all together.
struct TrafficStatistics
{
  std::string Kind;
  std::int64_t Messages = 0;
  std::int64_t Bytes = 0;
};

struct DistributedStatistics
{
  std::vector<RankStatistics> Ranks;     ///< by rank
  std::vector<MasterStatistics> Masters; ///< the whole domain's first
  std::vector<TrafficStatistics> Traffic;
  std::int64_t Partitions = 0;
  std::int64_t MajorPartitions = 0; ///< 0: one master
  int ThreadsPerRank = 0;
  double Seconds = 0; ///< of the slowest rank
};

/// Puts the ranks' figures together on all of them. Collective.
DistributedStatistics gatherStatistics(
  Postbox& ranks, const RankStatistics& own, const std::vector<MasterStatistics>& masters);

} // namespace tipp

#endif
