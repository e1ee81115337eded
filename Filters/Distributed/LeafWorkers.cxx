// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/LeafWorkers.h"

#include "Distributed/VertexLabelling.h"
#include "Parallel/ProcessorWatch.h"
#include "Triangulation/Worker.h"

#include <utility>

namespace tipp
{

/// What one thread works with.
template <typename Id>
class LeafWorkers<Id>::Place
{
public:
  explicit Place(LeafWorkers<Id>& workers)
    : Of(workers)
    , Triangulator(workers.Work.Leaves, workers.Buckets, workers.FirstId)
  {
  }

  Finished triangulate(Task& task)
  {
    const ProcessorWatch watch;
    const Area& area = this->Of.Work.Areas[std::size_t(task.Area)];
    this->Triangulator.setTiling(area.Boxes, area.FirstLeaf);
    this->Triangulator.triangulate(task.Partition, labelVertices(area.Boxes, task.Vertices));
    Finished finished;
    finished.Result.Area = task.Area;
    finished.Result.Partition = task.Partition;
    finished.Result.Seams = this->Grouping.group(this->Triangulator.seams(), task.Partition);
    finished.Result.WorkerVertices = std::int64_t(this->Triangulator.vertexCount());
    finished.Duplicates = this->Triangulator.duplicates();
    finished.InteriorCount = this->Triangulator.interiorCount();
    finished.Result.Seconds = watch.seconds();
    return finished;
  }

private:
  LeafWorkers<Id>& Of;
  Worker<Id> Triangulator;
  SeamGrouping Grouping;
};

template <typename Id>
LeafWorkers<Id>::LeafWorkers(
  const Plan& plan, PointBuckets<Id>& buckets, std::int64_t firstId, int threads)
  : InteriorCounts(static_cast<std::size_t>(plan.Leaves.size()), 0)
  , Work(plan)
  , Buckets(buckets)
  , FirstId(firstId)
{
  try
  {
    for (int i = 0; i < threads; ++i)
    {
      this->Threads.emplace_back([this]() { this->work(); });
    }
  }
  catch (...)
  {
    this->stop(); // the system gave some, but not all
    throw;
  }
}

template <typename Id>
LeafWorkers<Id>::~LeafWorkers()
{
  this->stop();
}

template <typename Id>
void LeafWorkers<Id>::stop()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Stopped = true;
  }
  this->TaskCame.notify_all();
  for (std::thread& thread : this->Threads)
  {
    thread.join();
  }
}

template <typename Id>
void LeafWorkers<Id>::give(Task task)
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Tasks.push_back(std::move(task));
    ++this->Unfinished;
  }
  this->TaskCame.notify_one();
}

template <typename Id>
bool LeafWorkers<Id>::take(TaskResult& result)
{
  Finished finished;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Failure)
    {
      std::rethrow_exception(this->Failure);
    }
    if (this->Results.empty())
    {
      return false;
    }
    finished = std::move(this->Results.front());
    this->Results.pop_front();
    --this->Unfinished;
  }
  result = std::move(finished.Result);
  const PartitionIndex leaf =
    this->Work.Areas[std::size_t(result.Area)].FirstLeaf + result.Partition;
  this->InteriorCounts[std::size_t(leaf)] = finished.InteriorCount;
  this->Duplicates.insert(
    this->Duplicates.end(), finished.Duplicates.begin(), finished.Duplicates.end());
  this->Seconds += result.Seconds;
  this->PointsDone += this->Buckets.count(leaf);
  return true;
}

template <typename Id>
void LeafWorkers<Id>::waitFor(double seconds)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->ResultCame.wait_for(lock, std::chrono::duration<double>(seconds),
    [this]() { return !this->Results.empty() || this->Failure; });
}

template <typename Id>
bool LeafWorkers<Id>::isIdle()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Unfinished == 0;
}

template <typename Id>
bool LeafWorkers<Id>::hasTasksWaiting()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return !this->Tasks.empty();
}

template <typename Id>
void LeafWorkers<Id>::work()
{
  try
  {
    Place place(*this);
    for (;;)
    {
      Task task;
      {
        std::unique_lock<std::mutex> lock(this->Mutex);
        this->TaskCame.wait(lock, [this]() { return this->Stopped || !this->Tasks.empty(); });
        if (this->Stopped)
        {
          return;
        }
        task = std::move(this->Tasks.front());
        this->Tasks.pop_front();
      }
      Finished finished = place.triangulate(task);
      {
        const std::lock_guard<std::mutex> lock(this->Mutex);
        this->Results.push_back(std::move(finished));
      }
      this->ResultCame.notify_one();
    }
  }
  catch (...)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Failure = std::current_exception();
    this->ResultCame.notify_one();
  }
}

template class LeafWorkers<std::int32_t>;
template class LeafWorkers<std::int64_t>;

} // namespace tipp
