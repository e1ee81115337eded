// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/RankRun.h"

#include "Distributed/InitialPoints.h"
#include "Distributed/MessageKinds.h"
#include "Distributed/TaskMessages.h"
#include "Distributed/VertexLabelling.h"
#include "Parallel/ProcessorWatch.h"
#include "Triangulation/HullRepair.h"
#include "Triangulation/InitialMesh.h"

#include <algorithm>
#include <numeric>

namespace tipp
{
namespace
{

bool placeLess(const PlainVertex& a, const PlainVertex& b)
{
  return lexicographicLess(a.Place, b.Place);
}

/// The known vertices, and the others that lie at none of their places: what the rest of the mesh
/// knows keeps its ids.
std::vector<PlainVertex> unite(
  std::vector<PlainVertex> known, const std::vector<PlainVertex>& others)
{
  std::sort(known.begin(), known.end(), placeLess);
  known.erase(std::unique(known.begin(), known.end(),
                [](const PlainVertex& a, const PlainVertex& b) { return a.Id == b.Id; }),
    known.end());
  const std::size_t size = known.size();
  for (const PlainVertex& v : others)
  {
    const auto end = known.begin() + std::ptrdiff_t(size);
    if (!std::binary_search(known.begin(), end, v, placeLess))
    {
      known.push_back(v);
    }
  }
  return known;
}

std::vector<SeamVertex> labelled(const Tiling& tiling, const std::vector<PlainVertex>& vertices)
{
  std::vector<SeamVertex> result;
  result.reserve(vertices.size());
  for (const PlainVertex& v : vertices)
  {
    result.push_back(makeSeamVertex(tiling, tiling.locate(v.Place), v.Place, v.Id));
  }
  return result;
}

/// Those triangles that meet one of the area's own partitions.
SeamTriangles thoseMeeting(const Area& area, const SeamTriangles& all)
{
  SeamTriangles kept;
  kept.Vertices = all.Vertices;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (std::any_of(
          all.metBegin(i), all.metEnd(i), [&area](PartitionIndex p) { return p < area.Inner; }))
    {
      kept.add(all.Triangles[i], all.metBegin(i), all.metEnd(i));
    }
  }
  return kept;
}

} // namespace

template <typename Id>
RankRun<Id>::RankRun(Postbox& ranks, const Plan& plan, OwnedPoints<Id>& points,
  const std::vector<std::int64_t>& leafCounts, const DistributedOptions& options, int threads)
  : Ranks(ranks)
  , Work(plan)
  , Points(points)
  , LeafCounts(leafCounts)
  , Options(options)
  , Threads(threads)
  , Workers(plan, points.Buckets, points.FirstIds[std::size_t(ranks.rank())], threads)
{
}

template <typename Id>
std::vector<PartitionIndex> RankRun<Id>::withPoints(const Area& area) const
{
  std::vector<PartitionIndex> partitions;
  for (PartitionIndex p = 0; p < area.Inner; ++p)
  {
    const Area& leaves =
      area.hasLeaves() ? area : this->Work.Areas[std::size_t(area.Children[std::size_t(p)])];
    const auto begin = this->LeafCounts.begin() + leaves.FirstLeaf + (area.hasLeaves() ? p : 0);
    const auto end = begin + (area.hasLeaves() ? 1 : leaves.Inner);
    if (std::any_of(begin, end, [](std::int64_t count) { return count > 0; }))
    {
      partitions.push_back(p);
    }
  }
  return partitions;
}

/// A rank has a few partitions waiting, so that its threads need not: the more, the smaller they
/// are. A shift has one for each thread.
template <typename Id>
int RankRun<Id>::capacity(const Area& area) const
{
  constexpr std::int64_t waitingPoints = 16384;
  constexpr std::int64_t mostWaiting = 8;
  if (!area.hasLeaves())
  {
    return 1;
  }
  if (this->Options.Order == RankSchedule::Stages)
  {
    return this->Threads;
  }
  const auto begin = this->LeafCounts.begin() + area.FirstLeaf;
  const std::int64_t points = std::accumulate(begin, begin + area.Inner, std::int64_t(0));
  const std::int64_t mean = std::max<std::int64_t>(1, points / area.Inner);
  return this->Threads + int(std::clamp<std::int64_t>(waitingPoints / mean, 1, mostWaiting));
}

template <typename Id>
void RankRun<Id>::beginDispatcher(std::int32_t index, const SeamTriangles& mesh)
{
  const Area& area = this->Work.Areas[std::size_t(index)];
  Active& active = this->Dispatchers[index];
  active.Master = std::make_unique<Dispatcher>(
    area, index, mesh, this->withPoints(area), this->Options.Order, this->capacity(area));
}

template <typename Id>
void RankRun<Id>::beginTop()
{
  const ProcessorWatch watch;
  const Tiling& boxes = this->Work.Areas.front().Boxes;
  this->Artificial = makeArtificialPoints(boxes);
  std::vector<SeamVertex> vertices = labelled(boxes, this->InitialPoints[0]);
  vertices.insert(vertices.end(), this->Artificial.begin(), this->Artificial.end());
  const SeamTriangles mesh = triangulateVertices(boxes, vertices, this->Threads);
  const bool chosen = this->Options.Minor.isGiven() || this->Options.Major.isGiven();
  this->PartitionsPay = !this->Artificial.empty() && (chosen || partitionsPay(mesh));
  if (this->PartitionsPay)
  {
    this->beginDispatcher(0, mesh);
    this->Dispatchers[0].MoreSeconds += watch.seconds() - this->Dispatchers[0].Master->Seconds;
  }
}

/// A major partition has come to this rank, its sub-master: refines the mesh (step 4.1).
template <typename Id>
void RankRun<Id>::beginArea(std::int32_t parent, Task task)
{
  const ProcessorWatch watch;
  const std::int32_t index =
    this->Work.Areas[std::size_t(parent)].Children[std::size_t(task.Partition)];
  const Area& area = this->Work.Areas[std::size_t(index)];
  const std::vector<PlainVertex> vertices =
    unite(std::move(task.Vertices), this->InitialPoints[index]);
  this->beginDispatcher(index,
    thoseMeeting(
      area, triangulateVertices(area.Boxes, labelled(area.Boxes, vertices), this->Threads)));
  Active& active = this->Dispatchers[index];
  active.Parent = parent;
  active.Partition = task.Partition;
  active.MoreSeconds = watch.seconds() - active.Master->Seconds;
}

template <typename Id>
void RankRun<Id>::handleTask(Task task)
{
  if (this->Work.Areas[std::size_t(task.Area)].hasLeaves())
  {
    this->Workers.give(std::move(task));
  }
  else
  {
    const std::int32_t area = task.Area;
    this->beginArea(area, std::move(task));
  }
}

template <typename Id>
void RankRun<Id>::giveTo(std::int32_t rank, Task task)
{
  if (rank == this->Ranks.rank())
  {
    this->handleTask(std::move(task));
  }
  else
  {
    this->Ranks.post(rank, TaskMessage, pack(task));
  }
}

/// A result goes to the master of its area.
template <typename Id>
void RankRun<Id>::deliver(std::int32_t master, TaskResult result)
{
  if (master != this->Ranks.rank())
  {
    this->Ranks.post(master, ResultMessage, pack(result));
    return;
  }
  this->Dispatchers.at(result.Area).Master->complete(std::move(result));
}

template <typename Id>
void RankRun<Id>::handle(Message& message)
{
  if (message.Kind == FinishedMessage)
  {
    this->Finished = true;
    return;
  }
  const ProcessorWatch watch;
  if (message.Kind == TaskMessage)
  {
    this->handleTask(unpackTask(message));
    return;
  }
  TaskResult result = unpackResult(message);
  Active& active = this->Dispatchers.at(result.Area);
  active.MoreSeconds += watch.seconds();
  active.Master->complete(std::move(result));
}

template <typename Id>
void RankRun<Id>::dispatchAll()
{
  // A dispatcher that finishes may let its parent go on, and tasks begin new ones.
  for (bool again = true; again;)
  {
    again = false;
    std::vector<std::int32_t> areas;
    for (const auto& entry : this->Dispatchers)
    {
      areas.push_back(entry.first);
    }
    for (const std::int32_t index : areas)
    {
      std::vector<Task> begun; // dispatchers, once this one is through
      Dispatcher& dispatcher = *this->Dispatchers.at(index).Master;
      dispatcher.dispatch(
        [&](std::int32_t rank, Task task)
        {
          if (rank == this->Ranks.rank() && !dispatcher.area().hasLeaves())
          {
            begun.push_back(std::move(task));
          }
          else
          {
            this->giveTo(rank, std::move(task));
          }
        });
      for (Task& task : begun)
      {
        this->giveTo(this->Ranks.rank(), std::move(task));
        again = true;
      }
      if (dispatcher.isDone())
      {
        this->finishArea(index);
        again = true;
      }
    }
  }
}

template <typename Id>
void RankRun<Id>::keepFigures(const Dispatcher& dispatcher, std::int32_t index)
{
  MasterStatistics figures;
  figures.Area = index;
  figures.Rank = this->Ranks.rank();
  std::vector<std::int32_t> group;
  for (const auto& home : dispatcher.area().Homes)
  {
    group.insert(group.end(), home.begin(), home.end());
  }
  std::sort(group.begin(), group.end());
  figures.GroupSize = std::int32_t(std::unique(group.begin(), group.end()) - group.begin());
  figures.LargestMesh = std::int64_t(dispatcher.LargestMesh);
  figures.PathSeconds = dispatcher.PathSeconds;
  figures.Seconds = dispatcher.Seconds + this->Dispatchers.at(index).MoreSeconds;
  for (const Dispatcher::Stage& stage : dispatcher.Stages)
  {
    figures.Stages.push_back({ stage.ActivePartitions, stage.MeshTriangles });
  }
  (index == 0 ? this->Statistics.MasterSeconds : this->Statistics.SubMasterSeconds) +=
    figures.Seconds;
  this->Masters.push_back(std::move(figures));
}

template <typename Id>
void RankRun<Id>::finishArea(std::int32_t index)
{
  const ProcessorWatch watch;
  Active& active = this->Dispatchers.at(index);
  Dispatcher& dispatcher = *active.Master;
  this->Kept.append(std::move(dispatcher.Kept));
  if (active.Parent < 0)
  {
    this->finishTop(dispatcher);
    active.MoreSeconds += watch.seconds();
    this->keepFigures(dispatcher, index);
    this->Dispatchers.erase(index);
    return;
  }
  const Area& parent = this->Work.Areas[std::size_t(active.Parent)];
  const SeamTriangles seams = labelTriangles(parent.Boxes, dispatcher.Upward);
  TaskResult result;
  result.Area = active.Parent;
  result.Partition = active.Partition;
  result.WorkerVertices = dispatcher.WorkerVertices;
  result.Seconds = dispatcher.PathSeconds;
  result.Seams = SeamGrouping().group(seams, active.Partition);
  active.MoreSeconds += watch.seconds();
  this->keepFigures(dispatcher, index);
  this->Dispatchers.erase(index);
  this->deliver(parent.Lead, std::move(result));
}

template <typename Id>
void RankRun<Id>::finishTop(Dispatcher& top)
{
  removeArtificialPoints(top.Upward, this->Artificial);
  for (const SeamTriangle& triangle : top.Upward)
  {
    this->Kept.push_back({ triangle[0].Id, triangle[1].Id, triangle[2].Id });
  }
  this->Statistics.WorkerVertices = top.WorkerVertices;
  for (int rank = 0; rank < this->Ranks.size(); ++rank)
  {
    if (rank != this->Ranks.rank())
    {
      this->Ranks.post(rank, FinishedMessage, Bytes());
    }
  }
  this->Finished = true;
}

template <typename Id>
void RankRun<Id>::report()
{
  this->SinceReport.restart();
  const double all = double(std::max<std::size_t>(1, this->Points.size()));
  if (this->Options.Progress && !this->Options.Progress(double(this->Workers.PointsDone) / all))
  {
    throw RankFailure(this->Ranks.rank(), true, "The run was stopped.");
  }
}

/// Takes in what has come; false if nothing had.
template <typename Id>
bool RankRun<Id>::step()
{
  bool moved = false;
  Message message;
  while (!this->Finished && this->Ranks.poll(message))
  {
    this->handle(message);
    moved = true;
  }
  for (TaskResult result; this->Workers.take(result); result = {})
  {
    ++this->Statistics.Partitions;
    this->TaskSeconds = result.Seconds;
    const std::int32_t master = this->Work.Areas[std::size_t(result.Area)].Lead;
    this->deliver(master, std::move(result));
    this->report();
    moved = true;
  }
  if (moved)
  {
    this->dispatchAll();
  }
  return moved;
}

template <typename Id>
void RankRun<Id>::wait()
{
  // Whoever looks for messages takes the processor from a thread that computes.
  constexpr double shortest = 150e-6;
  constexpr double longest = 2e-3;
  constexpr double withTasksWaiting = 1e-3;
  constexpr double untilReport = 0.1; // for a master without work of its own too
  if (this->SinceReport.seconds() > untilReport)
  {
    this->report();
  }
  if (!this->Workers.isIdle())
  {
    const double least = this->Workers.hasTasksWaiting() ? withTasksWaiting : shortest;
    this->Workers.waitFor(std::clamp(this->TaskSeconds / 4, least, longest));
    return;
  }
  const Stopwatch watch;
  this->Ranks.pause();
  this->Statistics.WaitSeconds += watch.seconds();
}

template <typename Id>
void RankRun<Id>::run()
{
  this->InitialPoints =
    gatherInitialPoints(this->Ranks, this->Work, this->Points, this->LeafCounts, this->Options);
  if (this->Ranks.rank() == 0)
  {
    this->beginTop();
  }
  ByteWriter writer;
  writer.value(char(this->PartitionsPay));
  const Bytes pay = this->Ranks.broadcast(writer.take());
  this->PartitionsPay = ByteReader(pay).value<char>() != 0;
  if (!this->PartitionsPay)
  {
    return;
  }
  this->dispatchAll();
  while (!this->Finished)
  {
    if (!this->step())
    {
      this->wait();
    }
  }
  this->Statistics.ComputeSeconds = this->Workers.Seconds;
  this->Duplicates = std::move(this->Workers.Duplicates);
  this->InteriorCounts = std::move(this->Workers.InteriorCounts);
}

template class RankRun<std::int32_t>;
template class RankRun<std::int64_t>;

} // namespace tipp
