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

/// The parts of a run that are the same on all ranks.
struct RankWork3
{
  const Tiling3& Tiling;       ///< each rank owns one of its groups of partitions
  const PartitionOrder& Order; ///< computed by each rank from the same initial mesh
  const TetrahedralizationOptions& Options;
  int Threads;

  int ownerOf(PartitionIndex p) const { return this->Tiling.groupOf(p); }
};

/// A rank's part of a triangulation in space: the rank triangulates the partitions whose points it
/// owns.
///
/// When a partition is done, one message goes to each rank that owns a later conflicting one. It
/// has the vertices for these partitions, and says that the partition is done. A rank has finished
/// when its partitions are done and all such messages have arrived. Results do not depend on the
/// order of these events.
class RankRun3
{
public:
  /// `points`: the points of this rank's partitions, and the regions of all partitions. Internal
  /// ids are the ids in `points` plus `firstId`. All references must outlive this object.
  RankRun3(
    Communicator& ranks, const RankWork3& work, const PointBuckets3& points, std::int64_t firstId);

  /// Runs the triangulation. `initial`: the messages of the initial mesh to all partitions.
  /// Collective. Throws RankFailure.
  void run(std::vector<VertexMessage3> initial);

  /// By thread: tetrahedra whose corners are all this rank's points, by indices of these.
  std::vector<std::vector<CellIds>> Inside;
  std::vector<IdCell<4>> Kept; ///< other tetrahedra that became final on this rank, by internal ids
  std::vector<Vertex3> HullVertices; ///< true corners of tetrahedra with artificial corners
  std::vector<Duplicate> Duplicates; ///< by internal ids
  RankStatistics Statistics;

private:
  struct Cells;

  PartitionIndex take();
  void notify();
  bool waitFor(PartitionIndex p);
  void work(Cells& cells);
  std::vector<std::int32_t> recipientsOf(PartitionIndex p) const;
  void finish(PartitionIndex p, SentMessages3&& sent);
  void receive(const Message& message);
  bool sendAndReceive();
  void coordinate();
  void report();

  /// A message to another rank about a finished partition.
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
  std::vector<std::atomic<char>> IsReady;    ///< by partition, if a thread has begun it
  std::vector<PartitionIndex> OwnPartitions; ///< in the order of work
  std::atomic<std::size_t> NextOwn{ 0 };
  std::vector<Inbox3> Inboxes;
  std::size_t AwaitedMessages = 0; ///< number of messages that will come from other ranks
  std::atomic<std::size_t> LeftPartitions{ 0 }; ///< this rank's partitions that are not done
  std::atomic<std::size_t> LeftToTake{ 0 };     ///< those that no thread has taken
  std::atomic<std::size_t> PointsDone{ 0 };
  std::atomic<int> Idle{ 0 };      ///< threads that wait for a partition
  std::condition_variable Changed; ///< signalled when a partition is done, here or on another rank
  std::mutex Mutex;                ///< protects ToSend, and results when a thread ends
  std::vector<Outgoing> ToSend;
  Stopwatch SinceReport;
};

} // namespace tipp

#endif
