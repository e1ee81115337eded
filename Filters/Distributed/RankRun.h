// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankRun_h
#define tippRankRun_h

#include "Distributed/DistributedTriangulation.h"
#include "Distributed/Plan.h"
#include "Distributed/PointExchange.h"
#include "Distributed/TriangleExchange.h"
#include "Engine/PartitionOrder.h"
#include "Engine/ReadyPartitions.h"
#include "Engine/Routing.h"
#include "Parallel/Stopwatch.h"
#include "Ranks/Communicator.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace tipp
{

/// Sorts the vertices by partition and, of several at the same position, keeps the one with the
/// lowest id, so that all ranks insert the same vertices. Applies to initial and to artificial
/// points.
VTKTIPPFILTERS_EXPORT void keepOneOfEachPosition(std::vector<BoundaryVertex>& vertices);

/// A part of the initial mesh: all its triangles that meet some partitions, and their neighbours.
///
/// It is computed without the rest of the initial mesh. A triangulation of all initial points of
/// some partitions and of a few points of the others has triangles that are not in the initial
/// mesh. But those that meet a chosen partition, and their neighbours, are in it as soon as all
/// initial points of the partitions that they meet are inserted, since no other point is in their
/// circumdisks. Then none of them is missing. (Proof. Let x be a point of a chosen region, or next
/// to one on a circumdisk that only touches it. The triangles of the initial mesh that are in
/// conflict with x are connected by edges, and one of them, the one that contains x, is in both
/// meshes, as are all of the local mesh that are in conflict with x. The neighbours of these are in
/// both meshes, so all can be reached.)
struct InitialMeshPart
{
  /// Computes the part for the partitions p with `isChosen[p]`. `initial` has all partitions'
  /// initial points, after keepOneOfEachPosition().
  VTKTIPPFILTERS_EXPORT InitialMeshPart(const Regions& regions,
    const std::vector<BoundaryVertex>& initial, const std::vector<BoundaryVertex>& artificial,
    const std::vector<char>& isChosen, int threads);

  /// Adds this part's counts for partitionsPay() to `triangles` and `met`. If every partition is
  /// chosen in exactly one part, the sums over all parts are those of the whole mesh.
  VTKTIPPFILTERS_EXPORT void countMet(std::int64_t& triangles, std::int64_t& met) const;

  /// Writes the chosen partitions' conflicts. Slow if partitioning does not pay off.
  VTKTIPPFILTERS_EXPORT void writeConflicts(SaveArchive& writer) const;

  BoundaryTriangles Mesh;
  std::vector<char> IsChosen;
};

/// Reads what the ranks wrote with writeConflicts(), concatenated, and returns all conflicts as
/// findConflicts() does. Each partition must have been chosen once. Throws std::runtime_error if
/// the bytes are damaged.
VTKTIPPFILTERS_EXPORT std::optional<ConflictGraph> readConflicts(
  const Bytes& all, std::size_t partitions);

/// Returns all ranks' bytes, concatenated by rank, on all ranks. Collective.
Bytes joinedOnAllRanks(Communicator& ranks, Bytes&& own);

constexpr MessageKind kindAfter(std::uint32_t n)
{
  return static_cast<MessageKind>(static_cast<std::uint32_t>(MessageKind::FirstFree) + n);
}

/// A partition is done; with the messages that it sends.
constexpr MessageKind PartitionDoneMessage = kindAfter(0);
/// With masters: a partition to triangulate, with its inbox.
constexpr MessageKind TaskMessage = kindAfter(1);

/// A rank's part of the triangulation: it triangulates the partitions whose points it owns.
///
/// Every rank finds the conflicts of some partitions in its part of the initial mesh, and computes
/// the order from all ranks' conflicts. One rank, the *keeper*, stores a partition's inbox,
/// receives a message when each partition that this one waits for is done, and then starts it. By
/// default it is the owner of the partition's points. With the dissertation's masters it is the
/// first rank (Algorithm 1), or the lead of its major partition's group (Algorithm 3).
///
/// A finished partition is one message to each rank that keeps its inbox or that of a later
/// conflicting partition: it contains the vertices for these, and marks the partition as done. A
/// rank has finished when all partitions that it owns or keeps are done; no termination protocol is
/// needed. Results do not depend on when messages arrive.
template <typename Id>
class RankRun
{
public:
  RankRun(Communicator& ranks, const Plan& plan, OwnedPoints<Id>& points,
    const DistributedOptions& options, int threads);

  /// Runs the triangulation. Collective. Throws RankFailure.
  void run();

  /// Boundary triangles that have become final on this rank, by internal ids.
  std::vector<IdTriangle> Kept;
  std::vector<Duplicate> Duplicates;       ///< with internal ids
  std::vector<std::size_t> InteriorCounts; ///< number of interior triangles, by partition
  RankStatistics Statistics;
  std::vector<MasterStatistics> Masters; ///< statistics of the masters on this rank
  bool PartitionsPay = true;             ///< the same on all ranks; false: nothing was done

private:
  /// A thread's part of the result.
  struct Contribution
  {
    FinalBoundary<std::int64_t> Boundary;
    std::vector<Duplicate> Duplicates;
    std::int64_t WorkerVertices = 0;
    std::int64_t Partitions = 0;
    std::vector<double> Seconds; ///< computing time, by colour
  };

  /// A finished partition's messages to another rank.
  struct Outgoing
  {
    int Rank;
    Bytes Content;
  };

  void makeInitialMesh();
  void shareInitialMesh(std::vector<BoundaryVertex>& vertices);
  void decideWhoWaits();
  void sendInitial(const BoundaryTriangles& part);
  std::int32_t ownerOf(PartitionIndex p) const { return this->Work.Owners[std::size_t(p)]; }
  std::int32_t keeperOf(PartitionIndex p) const { return this->Keepers[std::size_t(p)]; }
  std::vector<char> thoseOf(const std::vector<std::int32_t>& ranks) const;
  std::vector<std::int32_t> recipientsOf(PartitionIndex p) const;
  /// The queue from which threads take partitions.
  ReadyPartitions& source() { return this->hasMasters() ? *this->Started : *this->Ready; }
  void work(Contribution& part);
  void finishPartition(PartitionIndex p, SentMessages sent);
  void put(PartitionIndex to, VertexMessage&& message);
  void finish(PartitionIndex p);
  void receive(const Message& message);
  void receiveDone(const Message& message);
  bool sendAndReceive();
  void coordinate();
  void report();
  void repairHullOnFirst();
  void keepFigures(const std::vector<Contribution>& parts);

  /// @name Functions of a master
  ///@{
  bool hasMasters() const { return this->Started != nullptr; }
  bool startReady();
  bool canStart(PartitionIndex p) const;
  void start(PartitionIndex p);
  void receiveTask(const Message& message);
  ///@}

  Communicator& Ranks;
  const Plan& Work;
  OwnedPoints<Id>& Points;
  const DistributedOptions& Options;
  const int Threads;
  const std::int64_t FirstId;
  std::vector<BoundaryVertex> Artificial;
  std::unique_ptr<Regions> Boxes;
  std::unique_ptr<PartitionOrder> Order;
  std::vector<std::int32_t> Keepers;        ///< by partition: the rank that keeps its inbox
  std::vector<std::int32_t> AllKeepers;     ///< the different ranks in Keepers
  std::unique_ptr<ReadyPartitions> Ready;   ///< partitions that this rank keeps
  std::unique_ptr<ReadyPartitions> Started; ///< partitions that it owns; null: same as Ready
  std::vector<Inbox> Inboxes;
  FinalBoundary<std::int64_t> Boundary;
  std::size_t AwaitedMessages = 0; ///< messages of other ranks' finished partitions
  std::size_t AwaitedTasks = 0;
  std::atomic<std::size_t> LeftPartitions{ 0 }; ///< partitions of this rank that are not done
  std::atomic<std::size_t> PointsDone{ 0 };
  std::mutex OutgoingMutex; ///< guards the next two
  std::vector<Outgoing> ToSend;
  std::vector<PartitionIndex> DoneHere; ///< with masters: partitions for the main thread to finish

  // Used by masters only.
  std::vector<PartitionIndex> Waiting; ///< ready, but their ranks are busy
  std::vector<int> InFlight;           ///< by rank: number of partitions started and not done
  int AllInFlight = 0;
  std::atomic<std::int64_t> KeptTriangles{ 0 }; ///< triangles in the inboxes
  MasterStatistics Figures;

  Stopwatch SinceReport;
};

extern template class RankRun<std::int32_t>;
extern template class RankRun<std::int64_t>;

} // namespace tipp

#endif
