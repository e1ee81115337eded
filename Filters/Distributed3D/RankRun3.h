// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankRun3_h
#define tippRankRun3_h

#include "Distributed/DistributedTriangulation.h"
#include "Engine/PartitionOrder.h"
#include "Engine/ReadyPartitions.h"
#include "Parallel/Stopwatch.h"
#include "Ranks/Communicator.h"
#include "Triangulation3D/Dataflow3.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace tipp
{

/// What all ranks know of a run.
struct RankWork3
{
  const Tiling3& Tiling;       ///< the groups of its partitions are the ranks'
  const PartitionOrder& Order; ///< computed by each rank from the same initial mesh
  const TetrahedralizationOptions& Options;
  int Threads;

  int ownerOf(PartitionIndex p) const { return this->Tiling.groupOf(p); }
};

/// A rank's part of a triangulation in space: it triangulates the partitions whose points it owns.
///
/// A finished partition is one message to each rank that owns a later conflicting one: it has the
/// vertices for these, and tells that the partition is done. A rank has finished when its
/// partitions are done and all such messages have come. Results do not depend on when that is.
class RankRun3
{
public:
  /// `points`: by partition, of this rank's partitions; with the regions of all. Their ids are
  /// counted from `firstId`, which gives internal ids.
  RankRun3(
    Communicator& ranks, const RankWork3& work, const PointBuckets3& points, std::int64_t firstId);

  /// Runs the triangulation; `initial` has the initial mesh's messages to all partitions.
  /// Collective. Throws RankFailure.
  void run(std::vector<VertexMessage3> initial);

  /// Tetrahedra of this rank's points alone, by indices among these; of each thread.
  std::vector<std::vector<CellIds>> Inside;
  std::vector<IdCell<4>> Kept;       ///< the other ones that became final here, by internal ids
  std::vector<Vertex3> HullVertices; ///< of tetrahedra with artificial corners
  std::vector<Duplicate> Duplicates; ///< by internal ids
  RankStatistics Statistics;

private:
  struct Cells;

  PartitionIndex take();
  void notify();
  bool waitFor(PartitionIndex p);
  void work(Cells& cells);
  std::vector<std::int32_t> recipientsOf(PartitionIndex p) const;
  void finish(PartitionIndex p, SentMessages3 sent);
  void receive(const Message& message);
  bool sendAndReceive();
  void coordinate();
  void report();

  /// A finished partition's messages to another rank.
  struct Outgoing
  {
    int Rank;
    Bytes Content;
  };

  Communicator& Ranks;
  const RankWork3& Work;
  const PointBuckets3& Points;
  const std::int64_t FirstId;
  ReadyPartitions Ready;
  std::vector<std::atomic<char>> IsReady; ///< by partition; only of those that threads have begun
  std::vector<PartitionIndex> OwnPartitions; ///< in order
  std::atomic<std::size_t> NextOwn{ 0 };
  std::vector<Inbox3> Inboxes;
  std::size_t AwaitedMessages = 0; ///< of other ranks' finished partitions
  std::atomic<std::size_t> LeftPartitions{ 0 };
  std::atomic<std::size_t> LeftToTake{ 0 };
  std::atomic<std::size_t> PointsDone{ 0 };
  std::atomic<int> Idle{ 0 };      ///< threads that look for a partition
  std::condition_variable Changed; ///< a partition is done, here or on another rank
  std::mutex Mutex;                ///< for ToSend, and for results when a thread ends
  std::vector<Outgoing> ToSend;
  Stopwatch SinceReport;
};

} // namespace tipp

#endif
