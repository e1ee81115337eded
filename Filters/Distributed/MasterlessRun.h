// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMasterlessRun_h
#define tippMasterlessRun_h

#include "Distributed/DistributedOptions.h"
#include "Distributed/DistributedStatistics.h"
#include "Distributed/FinalTriangles.h"
#include "Distributed/Plan.h"
#include "Distributed/PointExchange.h"
#include "Engine/ReadyPartitions.h"
#include "Engine/Regions.h"
#include "Engine/Routing.h"
#include "Messages/Postbox.h"
#include "Parallel/Stopwatch.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace tipp
{

/// A rank's part of the triangulation without a master: it triangulates the partitions whose points
/// it owns, and keeps their inboxes.
///
/// Every rank computes conflicts and order from the same initial mesh. So each knows which
/// partitions its own ones wait for, and there is one message for a finished partition to each rank
/// that owns a later conflicting one: it carries the vertices for these partitions, and says that
/// the partition is done even where there are none. A rank has finished when its own partitions are
/// done; no protocol counts. Results do not depend on when messages arrive.
template <typename Id>
class MasterlessRun
{
public:
  MasterlessRun(Postbox& ranks, const Plan& plan, OwnedPoints<Id>& points,
    const DistributedOptions& options, int threads);

  /// Collective. Throws RankFailure.
  void run();

  /// Boundary triangles that have become final on this rank, by internal ids.
  FinalTriangles Kept;
  std::vector<Duplicate> Duplicates;       ///< by internal ids
  std::vector<std::size_t> InteriorCounts; ///< of each partition
  RankStatistics Statistics;
  bool PartitionsPay = true; ///< the same on all ranks; if not, nothing was done

private:
  /// What the threads contribute, each by itself.
  struct Contribution
  {
    FinalBoundary<std::int64_t> Boundary;
    std::vector<Duplicate> Duplicates;
    std::int64_t WorkerVertices = 0;
    std::int64_t Partitions = 0;
    double Seconds = 0;
  };

  /// The messages of one finished partition to another rank.
  struct Outgoing
  {
    int Rank;
    Bytes Content;
  };

  void makeInitialMesh();
  void shareInitialMesh(std::vector<SeamVertex>& vertices);
  void work(Contribution& part);
  void finishPartition(
    PartitionIndex p, std::vector<std::pair<PartitionIndex, VertexMessage>> sent);
  void receive(const Message& message);
  bool sendAndReceive();
  void coordinate();
  void report();
  void repairHullOnFirst();

  Postbox& Ranks;
  const Plan& Work;
  OwnedPoints<Id>& Points;
  const DistributedOptions& Options;
  const int Threads;
  const std::int64_t FirstId;
  std::vector<SeamVertex> Artificial;
  std::unique_ptr<Regions> Boxes;
  std::unique_ptr<PartitionOrder> Order;
  std::unique_ptr<ReadyPartitions> Ready;
  std::vector<Inbox> Inboxes;
  FinalBoundary<std::int64_t> Boundary;
  std::size_t AwaitedMessages = 0;
  std::atomic<std::size_t> LeftPartitions{ 0 }; ///< of this rank, not done
  std::atomic<std::size_t> PointsDone{ 0 };
  std::mutex OutgoingMutex;
  std::vector<Outgoing> ToSend;
  Stopwatch SinceReport;
};

extern template class MasterlessRun<std::int32_t>;
extern template class MasterlessRun<std::int64_t>;

} // namespace tipp

#endif
