// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankRun_h
#define tippRankRun_h

#include "Distributed/DistributedTriangulation.h"
#include "Distributed/Plan.h"
#include "Distributed/PointExchange.h"
#include "Distributed/RankEngine.h"
#include "Distributed/TriangleExchange.h"
#include "Engine/PartitionOrder.h"
#include "Engine/ReadyPartitions.h"
#include "Engine/Routing.h"
#include "Ranks/Communicator.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace tipp
{

/// Sorts the vertices by partition and, of several at the same position, keeps the one with the
/// lowest id, so that all ranks insert the same vertices. Applies to initial and to artificial
/// points.
VTKTIPPFILTERS_EXPORT void keepOneOfEachPosition(std::vector<BoundaryVertex>& vertices);

/// The conflicts of some partitions.
struct PartConflicts
{
  struct Row
  {
    PartitionIndex Partition;
    std::vector<PartitionIndex> Neighbours;
  };

  bool IsTotal = false; ///< nearly all partitions conflict
  std::vector<Row> Rows;
};

template <typename Archive>
void serialize(Archive& archive, PartConflicts::Row& row)
{
  archive(row.Partition, row.Neighbours);
}

template <typename Archive>
void serialize(Archive& archive, PartConflicts& conflicts)
{
  archive(conflicts.IsTotal, conflicts.Rows);
}

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

  /// Returns the chosen partitions' conflicts. Slow if partitioning does not pay off.
  VTKTIPPFILTERS_EXPORT PartConflicts conflicts() const;

  BoundaryTriangles Mesh;
  std::vector<char> IsChosen;
};

/// Returns all conflicts as findConflicts() does. Each partition must have been chosen in exactly
/// one part. Throws std::runtime_error if a partition is not below `partitions`.
VTKTIPPFILTERS_EXPORT std::optional<ConflictGraph> joinConflicts(
  const std::vector<PartConflicts>& parts, std::size_t partitions);

/// A rank's part of a triangulation in the plane.
///
/// Every rank finds the conflicts of some partitions in its part of the initial mesh, and computes
/// the order from all ranks' conflicts. With the dissertation's masters, the keeper of a partition
/// is the first rank (Algorithm 1), or the lead of its major partition's group (Algorithm 3).
template <typename Id>
class RankRun : public RankEngine<VertexMessage>
{
public:
  RankRun(Communicator& ranks, const Plan& plan, OwnedPoints<Id>& points,
    const DistributedOptions& options, int threads);

  /// Runs the triangulation. Collective. Throws RankFailure.
  void run();

  /// Boundary triangles that have become final on this rank, by internal ids.
  std::vector<IdTriangle> Kept;
  std::vector<std::size_t> InteriorCounts; ///< number of interior triangles, by partition
  std::vector<MasterStatistics> Masters;   ///< statistics of the masters on this rank
  bool PartitionsPay = true;               ///< the same on all ranks; false: nothing was done

private:
  /// A thread's part of the result.
  struct Contribution
  {
    FinalBoundary<std::int64_t> Boundary;
    std::vector<Duplicate> Duplicates;
    std::int64_t WorkerVertices = 0;
    std::vector<double> Seconds; ///< computing time, by colour
  };

  void makeInitialMesh();
  std::vector<BoundaryVertex> shareInitialPoints();
  void decideWhoWaits();
  void sendInitial(const BoundaryTriangles& part);
  std::int32_t ownerOf(PartitionIndex p) const override
  {
    return this->Work.Owners[std::size_t(p)];
  }
  std::int32_t keeperOf(PartitionIndex p) const override { return this->Keepers[std::size_t(p)]; }
  std::vector<char> thoseOf(const std::vector<std::int32_t>& ranks) const;
  std::vector<std::int32_t> recipientsOf(PartitionIndex p) const override;
  ReadyPartitions& source() override { return this->hasMasters() ? *this->Started : *this->Ready; }
  void work(Contribution& part);
  void put(PartitionIndex to, VertexMessage&& message) override;
  void setDone(PartitionIndex p) override;
  void setDoneHere(PartitionIndex p) override;
  void receive(const Message& message) override;
  void repairHullOnFirst();
  void keepFigures(const std::vector<Contribution>& parts);

  /// @name Functions of a master
  ///@{
  bool hasMasters() const { return this->Started != nullptr; }
  bool startPartitions() override;
  bool areOthersWaiting() const override { return this->hasMasters(); }
  bool canStart(PartitionIndex p) const;
  void start(PartitionIndex p);
  void receiveTask(const Message& message);
  ///@}

  const Plan& Work;
  OwnedPoints<Id>& Points;
  const DistributedOptions& Options;
  const int Threads;
  const std::int64_t FirstId;
  std::vector<BoundaryVertex> Artificial;
  std::unique_ptr<Regions> Boxes;
  std::unique_ptr<PartitionOrder> OwnOrder;
  std::vector<std::int32_t> Keepers;        ///< by partition: the rank that keeps its inbox
  std::vector<std::int32_t> AllKeepers;     ///< the different ranks in Keepers
  std::unique_ptr<ReadyPartitions> Ready;   ///< partitions that this rank keeps
  std::unique_ptr<ReadyPartitions> Started; ///< partitions that it owns; null: same as Ready
  FinalBoundary<std::int64_t> Boundary;

  // Used by masters only.
  std::vector<PartitionIndex> DoneHere; ///< for the main thread; protected by Mutex
  std::vector<PartitionIndex> Waiting;  ///< ready, but their ranks are busy
  std::vector<int> InFlight;            ///< by rank: number of partitions started and not done
  int AllInFlight = 0;
  std::atomic<std::int64_t> KeptTriangles{ 0 }; ///< triangles in the inboxes
  MasterStatistics Figures;
};

extern template class RankRun<std::int32_t>;
extern template class RankRun<std::int64_t>;

} // namespace tipp

#endif
