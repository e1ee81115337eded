// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Master.h"

#include "Parallel/Stopwatch.h"

namespace tipp
{
namespace
{

SeamMesh makeMesh(PartitionIndex partitions, const std::vector<PartitionIndex>& withPoints)
{
  SeamMesh mesh(partitions);
  std::vector<char> hasPoints(static_cast<std::size_t>(partitions), 0);
  for (const PartitionIndex p : withPoints)
  {
    hasPoints[std::size_t(p)] = 1;
  }
  for (PartitionIndex p = 0; p < partitions; ++p)
  {
    if (!hasPoints[std::size_t(p)])
    {
      mesh.finish(p);
    }
  }
  return mesh;
}

} // namespace

Master::Master(Schedule schedule, PartitionIndex partitions,
  const std::vector<PartitionIndex>& withPoints, const SeamTriangles& initialMesh)
  : Order(schedule)
  , Mesh(makeMesh(partitions, withPoints))
  , Waiting(this->Mesh, withPoints)
{
  this->take(initialMesh);
}

void Master::take(const SeamTriangles& seams)
{
  this->NewlyFinal.clear();
  this->Mesh.add(seams, this->NewlyFinal);
  this->Final.add(this->NewlyFinal);
}

/// The next partition, or -1 if none can be active now. Called with the mutex held.
PartitionIndex Master::next()
{
  if (this->Order == Schedule::Dynamic)
  {
    const PartitionIndex partition = this->Waiting.activateNext();
    if (partition >= 0)
    {
      this->Stages.push_back({ std::int64_t(this->Active) + 1, std::int64_t(this->Mesh.size()) });
    }
    return partition;
  }
  if (this->Stage.empty() && this->Active == 0)
  {
    this->Stage = this->Waiting.nextStage();
    this->Stages.push_back({ std::int64_t(this->Stage.size()), std::int64_t(this->Mesh.size()) });
    this->Changed.notify_all();
  }
  if (this->Stage.empty())
  {
    return -1;
  }
  const PartitionIndex partition = this->Stage.back();
  this->Stage.pop_back();
  return partition;
}

PartitionIndex Master::acquire(std::vector<SeamTriangle>& belonging)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  for (;;)
  {
    if (this->Stopped || (this->Waiting.isEmpty() && this->Stage.empty()))
    {
      return -1;
    }
    const Stopwatch watch;
    const PartitionIndex partition = this->next();
    if (partition >= 0)
    {
      ++this->Active;
      this->Mesh.gather(partition, belonging);
      this->Seconds += watch.seconds();
      return partition;
    }
    this->Seconds += watch.seconds();
    this->Changed.wait(lock);
  }
}

void Master::complete(PartitionIndex partition, const SeamTriangles& seams,
  const std::vector<Duplicate>& duplicates, std::size_t workerVertices)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const Stopwatch watch;
  this->Mesh.finish(partition);
  this->take(seams);
  this->Waiting.deactivate(partition);
  this->Duplicates.insert(this->Duplicates.end(), duplicates.begin(), duplicates.end());
  this->WorkerVertices += workerVertices;
  --this->Active;
  this->Seconds += watch.seconds();
  this->Changed.notify_all();
}

void Master::stop(const std::exception_ptr& reason)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Stopped = true;
  if (reason && !this->Failure)
  {
    this->Failure = reason;
  }
  this->Changed.notify_all();
}

} // namespace tipp
