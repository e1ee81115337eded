// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLeafWorkers_h
#define tippLeafWorkers_h

#include "Distributed/Plan.h"
#include "Distributed/SeamGroups.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Triangulate.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tipp
{

/// A partition to triangulate, or for a major one to look after.
struct Task
{
  std::int32_t Area = 0;
  PartitionIndex Partition = 0;
  std::vector<PlainVertex> Vertices; ///< of the triangles that belong to it, some repeated
};

struct TaskResult
{
  std::int32_t Area = 0;
  PartitionIndex Partition = 0;
  SeamGroups Seams;
  std::int64_t WorkerVertices = 0;
  double Seconds = 0; ///< of computing
};

/// The threads of a rank that triangulate leaves, beside its main thread that speaks to the other
/// ranks. Threads write interior triangles to the rank's buckets.
template <typename Id>
class LeafWorkers
{
public:
  LeafWorkers(const Plan& plan, PointBuckets<Id>& buckets, std::int64_t firstId, int threads);
  ~LeafWorkers();

  void give(Task task);

  /// A finished task's result, if there is one. Throws what a thread threw.
  bool take(TaskResult& result);

  /// Waits a moment for a result.
  void waitFor(double seconds);

  bool isIdle();

  /// More tasks than threads.
  bool hasTasksWaiting();

  /// What is left once all results are taken.
  std::vector<Duplicate> Duplicates;
  std::vector<std::size_t> InteriorCounts; ///< of each leaf
  double Seconds = 0;                      ///< of computing, by all threads together
  std::size_t PointsDone = 0;

private:
  struct Finished
  {
    TaskResult Result;
    std::vector<Duplicate> Duplicates;
    std::size_t InteriorCount = 0;
  };

  void work();
  void stop();
  class Place;

  const Plan& Work;
  PointBuckets<Id>& Buckets;
  const std::int64_t FirstId;
  std::mutex Mutex;
  std::condition_variable TaskCame;
  std::condition_variable ResultCame;
  std::deque<Task> Tasks;
  std::deque<Finished> Results;
  std::size_t Unfinished = 0;
  bool Stopped = false;
  std::exception_ptr Failure;
  std::vector<std::thread> Threads;
};

extern template class LeafWorkers<std::int32_t>;
extern template class LeafWorkers<std::int64_t>;

} // namespace tipp

#endif
