// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDispatcher_h
#define tippDispatcher_h

#include "Distributed/DistributedOptions.h"
#include "Distributed/FinalTriangles.h"
#include "Distributed/GroupMesh.h"
#include "Distributed/LeafWorkers.h"
#include "Distributed/Plan.h"
#include "Triangulation/IndependentPartitions.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

namespace tipp
{

/// A master: gives out the independent partitions of one area and takes their boundary triangles
/// back, until all are finished (Algorithm 1, steps 2 to 5). It does not know whether a partition
/// goes to a worker or, as a major one, to a master of its own: Algorithm 3 is this class at two
/// levels.
class Dispatcher
{
public:
  struct Stage
  {
    std::int64_t ActivePartitions;
    std::int64_t MeshTriangles; ///< not final when the stage began
  };

  /// Capacity: the partitions that a rank may have at a time. withPoints: the area's partitions
  /// that are to be triangulated.
  Dispatcher(const Area& area, std::int32_t areaIndex, const SeamTriangles& initialMesh,
    const std::vector<PartitionIndex>& withPoints, RankSchedule order, int capacity);

  /// Gives tasks to ranks as long as the schedule allows.
  using Give = std::function<void(std::int32_t rank, Task task)>;
  void dispatch(const Give& give);

  void complete(TaskResult&& result);

  bool isDone() const { return this->Active == 0 && this->allGivenOut(); }

  /// Triangles that meet nothing but this area's finished partitions; by their vertices' ids.
  FinalTriangles Kept;

  /// Final here, but they meet the rest of the domain or have an artificial vertex.
  std::vector<SeamTriangle> Upward;

  std::vector<Stage> Stages;
  std::size_t LargestMesh = 0;
  std::int64_t WorkerVertices = 0;
  double Seconds = 0; ///< spent here

  /// What computing takes at least where each rank has a processor: between barriers the longest
  /// rank's, all together.
  double PathSeconds = 0;

  const Area& area() const { return this->Of; }

private:
  bool allGivenOut() const { return this->Waiting.isEmpty() && this->StageLeft == 0; }
  bool canTake(std::size_t home) const;
  PartitionIndex next(std::size_t home);
  void beginStage();
  void addToPath(const std::vector<std::int32_t>& group, double seconds);
  void take(const GroupMesh::Final& final);
  void give(std::size_t home, PartitionIndex partition, const Give& giveTask);

  const Area& Of;
  const std::int32_t Index;
  const RankSchedule Order;
  const int Capacity;
  GroupMesh Mesh;
  IndependentPartitions Waiting;
  std::vector<std::deque<PartitionIndex>> StageOf; ///< of each home, still to be given out
  std::size_t StageLeft = 0;
  std::size_t Active = 0;
  std::vector<int> InFlight;        ///< of each rank
  std::vector<double> SinceBarrier; ///< of each rank: seconds of computing
  bool Changed = true; ///< something may have become independent since the last dispatch
};

} // namespace tipp

#endif
