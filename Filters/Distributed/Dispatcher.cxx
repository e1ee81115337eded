// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/Dispatcher.h"

#include "Parallel/ProcessorWatch.h"

#include <algorithm>

namespace tipp
{

Dispatcher::Dispatcher(const Area& area, std::int32_t areaIndex, const SeamTriangles& initialMesh,
  const std::vector<PartitionIndex>& withPoints, RankSchedule order, int capacity)
  : Of(area)
  , Index(areaIndex)
  , Order(order)
  , Capacity(capacity)
  , Mesh(area.Boxes.size(), withPoints)
  , Waiting(this->Mesh, withPoints, area.HomeOf)
  , StageOf(area.Homes.size())
{
  std::int32_t last = 0;
  for (const std::vector<std::int32_t>& home : area.Homes)
  {
    last = std::max(last, *std::max_element(home.begin(), home.end()));
  }
  this->InFlight.assign(std::size_t(last) + 1, 0);
  this->SinceBarrier.assign(std::size_t(last) + 1, 0);
  const ProcessorWatch watch;
  this->take(this->Mesh.add(SeamGrouping().group(initialMesh)));
  this->LargestMesh = this->Mesh.size();
  this->Seconds += watch.seconds();
}

bool Dispatcher::canTake(std::size_t home) const
{
  const auto isFree = [this](std::int32_t rank)
  { return this->InFlight[std::size_t(rank)] < this->Capacity; };
  return std::all_of(this->Of.Homes[home].begin(), this->Of.Homes[home].end(), isFree);
}

void Dispatcher::beginStage()
{
  const std::vector<PartitionIndex> stage = this->Waiting.nextStage();
  for (const PartitionIndex p : stage)
  {
    this->StageOf[std::size_t(this->Of.HomeOf[std::size_t(p)])].push_back(p);
  }
  this->StageLeft = stage.size();
  this->Stages.push_back({ std::int64_t(stage.size()), std::int64_t(this->Mesh.size()) });
}

PartitionIndex Dispatcher::next(std::size_t home)
{
  if (this->Order == RankSchedule::Dynamic)
  {
    const PartitionIndex partition = this->Waiting.activateNext(std::int32_t(home));
    if (partition >= 0)
    {
      this->Stages.push_back({ std::int64_t(this->Active) + 1, std::int64_t(this->Mesh.size()) });
    }
    return partition;
  }
  std::deque<PartitionIndex>& stage = this->StageOf[home];
  if (stage.empty())
  {
    return -1;
  }
  const PartitionIndex partition = stage.front();
  stage.pop_front();
  --this->StageLeft;
  return partition;
}

void Dispatcher::give(std::size_t home, PartitionIndex partition, const Give& giveTask)
{
  ++this->Active;
  for (const std::int32_t rank : this->Of.Homes[home])
  {
    ++this->InFlight[std::size_t(rank)];
  }
  Task task;
  task.Area = this->Index;
  task.Partition = partition;
  this->Mesh.gather(partition, task.Vertices);
  giveTask(this->Of.Homes[home].front(), std::move(task));
}

void Dispatcher::dispatch(const Give& giveTask)
{
  // A shift begins when the last one has ended.
  if (!this->Changed || (this->Order == RankSchedule::Stages && this->Active > 0))
  {
    return;
  }
  this->Changed = false;
  const ProcessorWatch watch;
  if (this->Order != RankSchedule::Dynamic && this->Active == 0 && this->StageLeft == 0 &&
    !this->Waiting.isEmpty())
  {
    this->beginStage();
  }
  for (std::size_t home = 0; home < this->Of.Homes.size(); ++home)
  {
    while (this->canTake(home))
    {
      const PartitionIndex partition = this->next(home);
      if (partition < 0)
      {
        break;
      }
      this->give(home, partition, giveTask);
    }
  }
  this->Seconds += watch.seconds();
}

void Dispatcher::complete(TaskResult&& result)
{
  const ProcessorWatch watch;
  const std::size_t home = std::size_t(this->Of.HomeOf[std::size_t(result.Partition)]);
  for (const std::int32_t rank : this->Of.Homes[home])
  {
    --this->InFlight[std::size_t(rank)];
  }
  --this->Active;
  this->addToPath(this->Of.Homes[home], result.Seconds);
  this->Mesh.finish(result.Partition);
  this->take(this->Mesh.add(std::move(result.Seams)));
  this->Waiting.deactivate(result.Partition);
  this->LargestMesh = std::max(this->LargestMesh, this->Mesh.size());
  this->WorkerVertices += result.WorkerVertices;
  this->Changed = true;
  this->Seconds += watch.seconds();
}

void Dispatcher::addToPath(const std::vector<std::int32_t>& group, double seconds)
{
  for (const std::int32_t rank : group)
  {
    this->SinceBarrier[std::size_t(rank)] += seconds;
  }
  const bool endsShift = this->Active == 0 && this->Order == RankSchedule::Stages;
  const bool endsStage = this->Active == 0 && this->StageLeft == 0 &&
    (this->Order != RankSchedule::Dynamic || this->Waiting.isEmpty());
  if (endsShift || endsStage)
  {
    this->PathSeconds += *std::max_element(this->SinceBarrier.begin(), this->SinceBarrier.end());
    this->SinceBarrier.assign(this->SinceBarrier.size(), 0);
  }
}

void Dispatcher::take(const GroupMesh::Final& final)
{
  const SeamGroups& groups = *final.Groups;
  for (const std::uint32_t g : final.Indices)
  {
    const auto met = groups.met(g);
    const auto vertices = groups.vertices(g);
    const bool stays = !groups.Groups[g].HasArtificial &&
      std::all_of(met.begin(), met.end(), [this](PartitionIndex p) { return p < this->Of.Inner; });
    for (const SeamGroups::Corners& corners : groups.triangles(g))
    {
      const PlainVertex& a = vertices[corners[0]];
      const PlainVertex& b = vertices[corners[1]];
      const PlainVertex& c = vertices[corners[2]];
      if (stays)
      {
        this->Kept.push_back({ a.Id, b.Id, c.Id });
      }
      else
      {
        this->Upward.push_back(
          { SeamVertex{ a.Place, a.Id, 0 }, { b.Place, b.Id, 0 }, { c.Place, c.Id, 0 } });
      }
    }
  }
}

} // namespace tipp
