// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankRun3_h
#define tippRankRun3_h

#include "Distributed/RankEngine.h"
#include "Engine/PartitionOrder.h"
#include "Engine/ReadyPartitions.h"
#include "Ranks/Communicator.h"
#include "Triangulation3D/Dataflow3.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
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

/// A rank's part of a triangulation in space.
class RankRun3 : public RankEngine<VertexMessage3>
{
public:
  /// `points`: the points of this rank's partitions, and the regions of all partitions. Internal
  /// ids are the ids in `points` plus `firstId`. All references must outlive this object.
  RankRun3(
    Communicator& ranks, const RankWork3& work, const PointBuckets3& points, std::int64_t firstId);

  /// Runs the triangulation. `initial`: the messages of the initial mesh to all partitions.
  /// Collective. Throws RankFailure.
  void run(SentMessages3 initial);

  /// By thread: tetrahedra whose corners are all this rank's points, by indices of these.
  std::vector<std::vector<CellIds>> Inside;
  std::vector<IdCell<4>> Kept; ///< other tetrahedra that became final on this rank, by internal ids
  std::vector<Vertex3> HullVertices; ///< true corners of tetrahedra with artificial corners

private:
  struct Cells;

  std::int32_t ownerOf(PartitionIndex p) const override { return this->Work.ownerOf(p); }
  ReadyPartitions& source() override { return this->Ready; }
  bool waitFor(PartitionIndex p);
  void work(Cells& cells);

  const RankWork3& Work;
  const PointBuckets3& Points;
  const std::int64_t FirstId;
  ReadyPartitions Ready;
  std::vector<std::atomic<char>> IsReady;    ///< by partition, if a thread has begun it
  std::vector<PartitionIndex> OwnPartitions; ///< in the order of work
  std::atomic<std::size_t> NextOwn{ 0 };
};

} // namespace tipp

#endif
