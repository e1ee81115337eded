// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMaster_h
#define tippMaster_h

#include "Triangulation/FinalSeams.h"
#include "Triangulation/IndependentPartitions.h"
#include "Triangulation/SeamMesh.h"
#include "Triangulation/Triangulate.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <vector>

namespace tipp
{

/// Hands partitions to workers and takes their results (Algorithm 1, steps 2 to 5). Workers are
/// threads that ask for a partition, triangulate it and bring it back, until none is left.
class Master
{
public:
  /// Partitions without points are finished from the start.
  Master(Schedule schedule, PartitionIndex partitions,
    const std::vector<PartitionIndex>& withPoints, const SeamTriangles& initialMesh);

  /// A partition to triangulate and the triangles that belong to it; waits for one. -1 if there is
  /// nothing left to do, or the run is stopped.
  PartitionIndex acquire(std::vector<SeamTriangle>& belonging);

  void complete(PartitionIndex partition, const SeamTriangles& seams,
    const std::vector<Duplicate>& duplicates, std::size_t workerVertices);

  /// No further partition is handed out.
  void stop(const std::exception_ptr& reason = nullptr);

  bool isStopped() const { return this->Stopped; }
  std::exception_ptr failure() const { return this->Failure; }

  /// What has come together, once all workers are through.
  FinalSeams Final;
  std::vector<Duplicate> Duplicates;
  std::vector<TriangulationStatistics::Stage> Stages;
  std::size_t WorkerVertices = 0;
  double Seconds = 0; ///< spent here, by all threads together

private:
  PartitionIndex next();
  void take(const SeamTriangles& seams);

  const Schedule Order;
  std::mutex Mutex;
  std::condition_variable Changed;
  SeamMesh Mesh;
  std::vector<SeamTriangle> NewlyFinal;
  IndependentPartitions Waiting;
  std::vector<PartitionIndex> Stage; ///< independent partitions still to be handed out
  std::size_t Active = 0;
  bool Stopped = false;
  std::exception_ptr Failure;
};

} // namespace tipp

#endif
