// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/RankRun.h"

#include "Arrays/SortUnique.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

struct RegionEntry
{
  Box2 Box;
  PartitionIndex Partition;
};

/// Sums the statistics of several masters stage by stage.
void addStages(const std::vector<TriangulationStatistics::Stage>& more,
  std::vector<TriangulationStatistics::Stage>& stages)
{
  stages.resize(std::max(stages.size(), more.size()));
  for (std::size_t i = 0; i < more.size(); ++i)
  {
    stages[i].ActivePartitions += more[i].ActivePartitions;
    stages[i].MeshTriangles += more[i].MeshTriangles;
  }
}

} // namespace

template <typename Id>
RankRun<Id>::RankRun(Communicator& ranks, const Plan& plan, OwnedPoints<Id>& points,
  const DistributedOptions& options, int threads)
  : RankEngine(ranks, std::size_t(plan.Leaves.size()), points.size(), options.Progress)
  , InteriorCounts(static_cast<std::size_t>(plan.Leaves.size()), 0)
  , Work(plan)
  , Points(points)
  , Options(options)
  , Threads(threads)
  , FirstId(points.FirstIds[std::size_t(ranks.rank())])
{
}

/// Gathers the regions and initial points of all partitions on all ranks. Those of a partition come
/// from its owner.
template <typename Id>
std::vector<BoundaryVertex> RankRun<Id>::shareInitialPoints()
{
  const Tiling& tiles = this->Work.Leaves;
  const Regions own(tiles, this->Points.Buckets, this->Threads);
  const int wanted = this->Options.InitialPointsPerPartition > 0
    ? this->Options.InitialPointsPerPartition
    : InitialPointsOfPartition;
  std::vector<BoundaryVertex> initial =
    chooseInitialPoints(tiles, this->Points.Buckets, wanted, this->Threads);
  std::vector<RegionEntry> regions;
  for (PartitionIndex p = 0; p < tiles.size(); ++p)
  {
    if (own.areUsed()[std::size_t(p)])
    {
      regions.push_back({ own[p], p });
    }
  }
  for (BoundaryVertex& v : initial)
  {
    v.Id += this->FirstId;
  }
  keepOneOfEachPosition(initial);
  std::vector<Box2> boxes(std::size_t(tiles.size()), Box2{});
  std::vector<char> used(std::size_t(tiles.size()), 0);
  for (const RegionEntry& entry : concatenated(this->Ranks.allGather(regions)))
  {
    boxes.at(std::size_t(entry.Partition)) = entry.Box;
    used.at(std::size_t(entry.Partition)) = 1;
  }
  this->Boxes = std::make_unique<Regions>(tiles, std::move(boxes), std::move(used));
  return concatenated(this->Ranks.allGather(initial));
}

/// For each partition, whether `ranks` assigns it to this rank and it has points.
template <typename Id>
std::vector<char> RankRun<Id>::thoseOf(const std::vector<std::int32_t>& ranks) const
{
  std::vector<char> those(ranks.size(), 0);
  for (std::size_t p = 0; p < those.size(); ++p)
  {
    those[p] = ranks[p] == this->Ranks.rank() && this->Boxes->areUsed()[p];
  }
  return those;
}

template <typename Id>
void RankRun<Id>::makeInitialMesh()
{
  const std::vector<BoundaryVertex> vertices = this->shareInitialPoints();
  this->Artificial = makeArtificialPoints(this->Work.Leaves);
  keepOneOfEachPosition(this->Artificial);
  if (this->Artificial.empty())
  {
    this->PartitionsPay = false;
    return;
  }
  this->Keepers = this->Options.isMasterless() ? this->Work.Owners : this->Work.masters();
  const InitialMeshPart part(
    *this->Boxes, vertices, this->Artificial, this->thoseOf(this->Keepers), this->Threads);
  std::vector<std::int64_t> counts(2, 0);
  part.countMet(counts[0], counts[1]);
  this->Ranks.sum(counts);
  const bool chosen = this->Options.Minor.isGiven() || this->Options.Major.isGiven();
  this->PartitionsPay = chosen || partitionsPay(counts[0], counts[1]);
  if (this->PartitionsPay)
  {
    this->OwnOrder = std::make_unique<PartitionOrder>(this->Boxes->areUsed(),
      joinConflicts(this->Ranks.allGather(part.conflicts()), this->Keepers.size()));
    this->decideWhoWaits();
    this->sendInitial(part.Mesh);
  }
}

template <typename Id>
void RankRun<Id>::decideWhoWaits()
{
  using Waits = ReadyPartitions::Waits;
  const bool isMasterless = this->Options.isMasterless();
  const bool hasBarriers = this->Options.Order != RankSchedule::Dynamic;
  this->AllKeepers = this->Keepers;
  sortUnique(this->AllKeepers);
  this->InFlight.assign(std::size_t(this->Ranks.size()), 0);
  this->Ready = std::make_unique<ReadyPartitions>(*this->OwnOrder,
    hasBarriers ? Waits::ForColour : Waits::ForEarlier, this->thoseOf(this->Keepers));
  if (!isMasterless)
  {
    this->Started = std::make_unique<ReadyPartitions>(
      *this->OwnOrder, Waits::ForLoad, this->thoseOf(this->Work.Owners));
  }
  this->begin(*this->OwnOrder, this->OwnOrder->sequence());
}

template <typename Id>
std::vector<std::int32_t> RankRun<Id>::recipientsOf(PartitionIndex p) const
{
  std::vector<std::int32_t> ranks = RankEngine::recipientsOf(p);
  if (this->hasMasters())
  {
    ranks.push_back(this->keeperOf(p));
  }
  if (this->Options.Order != RankSchedule::Dynamic)
  {
    ranks.insert(ranks.end(), this->AllKeepers.begin(), this->AllKeepers.end());
  }
  sortUnique(ranks);
  return ranks;
}

/// Sends the triangles of this rank's part of the initial mesh to the inboxes that it keeps.
template <typename Id>
void RankRun<Id>::sendInitial(const BoundaryTriangles& part)
{
  for (auto& [to, message] : sendInitialMesh(part, *this->Order))
  {
    if (this->keeperOf(to) == this->Ranks.rank())
    {
      this->put(to, std::move(message));
    }
  }
}

template <typename Id>
void RankRun<Id>::put(PartitionIndex to, VertexMessage&& message)
{
  this->KeptTriangles += message.Cells;
  RankEngine::put(to, std::move(message));
}

/// A worker thread's loop.
template <typename Id>
void RankRun<Id>::work(Contribution& part)
{
  Worker<Id> worker(this->Work.Leaves, this->Points.Buckets, this->FirstId);
  Routing<Id> routing(*this->Order, *this->Boxes);
  UniqueVertices unique;
  part.Seconds.assign(this->Order->colourCount(), 0);
  for (PartitionIndex p = this->take(); p >= 0; p = this->take())
  {
    const ProcessorWatch watch;
    routing.setPartition(p);
    worker.triangulate(
      p, unique.collect(this->Inboxes[std::size_t(p)].take()), (*this->Boxes)[p], routing);
    SentMessages sent = routing.send(worker, part.Boundary);
    this->InteriorCounts[std::size_t(p)] = worker.interiorCount();
    part.WorkerVertices += std::int64_t(worker.vertexCount());
    part.Duplicates.insert(
      part.Duplicates.end(), worker.duplicates().begin(), worker.duplicates().end());
    part.Seconds[this->Order->colourOf(p)] += watch.seconds();
    this->finish(p, std::move(sent), this->Points.Buckets.count(p));
  }
}

template <typename Id>
void RankRun<Id>::setDone(PartitionIndex p)
{
  this->Ready->finish(p);
  if (this->hasMasters() && this->keeperOf(p) == this->Ranks.rank())
  {
    --this->InFlight[std::size_t(this->ownerOf(p))];
    --this->AllInFlight;
  }
}

template <typename Id>
void RankRun<Id>::setDoneHere(PartitionIndex p)
{
  if (!this->hasMasters())
  {
    this->Ready->finish(p);
    return;
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->DoneHere.push_back(p);
}

template <typename Id>
void RankRun<Id>::receive(const Message& message)
{
  if (message.Kind == TaskMessage)
  {
    this->receiveTask(message);
    return;
  }
  const ProcessorWatch watch;
  RankEngine::receive(message);
  this->Figures.Seconds += watch.seconds();
}

/// Repairs the hull (Lemma 3). The first rank has the triangles at the hull.
template <typename Id>
void RankRun<Id>::repairHullOnFirst()
{
  std::vector<BoundaryVertex> vertices = gatherList(this->Ranks, this->Boundary.HullVertices);
  if (this->Ranks.rank() == 0)
  {
    repairHull(std::move(vertices), this->Artificial, this->Boundary);
  }
}

template <typename Id>
void RankRun<Id>::run()
{
  this->makeInitialMesh();
  if (!this->PartitionsPay)
  {
    return;
  }
  std::vector<Contribution> parts(std::size_t(this->Threads));
  const double seconds = this->runThreads(parts, [this](Contribution& part) { this->work(part); });
  for (Contribution& part : parts)
  {
    this->Boundary.append(std::move(part.Boundary));
    this->Duplicates.insert(this->Duplicates.end(), part.Duplicates.begin(), part.Duplicates.end());
    this->Statistics.WorkerVertices += part.WorkerVertices;
    this->Statistics.ComputeSeconds +=
      std::accumulate(part.Seconds.begin(), part.Seconds.end(), 0.0);
  }
  this->Statistics.WaitSeconds =
    std::max(0.0, seconds - this->Statistics.ComputeSeconds / this->Threads);
  if (this->hasMasters())
  {
    this->keepFigures(parts);
  }
  this->repairHullOnFirst();
  for (const auto& triangle : this->Boundary.Triangles)
  {
    this->Kept.push_back(triangle.Ids);
  }
}

/// Whether a partition may start now. With barriers, a rank gets at most one partition per thread;
/// in waves (Algorithm 1), all started partitions must be done first.
template <typename Id>
bool RankRun<Id>::canStart(PartitionIndex p) const
{
  return this->Options.Order == RankSchedule::Dynamic ||
    this->InFlight[std::size_t(this->ownerOf(p))] < this->Threads;
}

/// Marks this rank's partitions as done, and starts all partitions that may start. Returns false if
/// there are none.
template <typename Id>
bool RankRun<Id>::startPartitions()
{
  if (!this->hasMasters())
  {
    return false;
  }
  std::vector<PartitionIndex> done;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    done.swap(this->DoneHere);
  }
  std::for_each(done.begin(), done.end(), [this](PartitionIndex p) { this->setDone(p); });
  const ProcessorWatch watch;
  for (PartitionIndex p = this->Ready->tryTake(); p >= 0; p = this->Ready->tryTake())
  {
    this->Waiting.push_back(p);
  }
  if (this->Waiting.empty() ||
    (this->Options.Order == RankSchedule::Stages && this->AllInFlight > 0))
  {
    return false;
  }
  std::vector<PartitionIndex> waiting;
  std::swap(waiting, this->Waiting);
  for (const PartitionIndex p : waiting)
  {
    if (this->canStart(p))
    {
      this->start(p);
    }
    else
    {
      this->Waiting.push_back(p);
    }
  }
  this->Figures.Seconds += watch.seconds();
  return this->Waiting.size() < waiting.size();
}

template <typename Id>
void RankRun<Id>::start(PartitionIndex p)
{
  std::vector<VertexMessage> messages = this->Inboxes[std::size_t(p)].take();
  VertexMessage all{ -1, 0, UniqueVertices().collect(messages) };
  for (const VertexMessage& message : messages)
  {
    all.Cells += message.Cells;
  }
  const std::int32_t owner = this->ownerOf(p);
  ++this->InFlight[std::size_t(owner)];
  ++this->AllInFlight;
  const std::int64_t kept = this->KeptTriangles;
  this->Figures.LargestMesh = std::max(this->Figures.LargestMesh, kept);
  const bool hasBarriers = this->Options.Order != RankSchedule::Dynamic;
  const std::size_t colour = this->Order->colourOf(p);
  if (!hasBarriers)
  {
    this->Figures.Stages.push_back({ this->AllInFlight, kept });
  }
  else
  {
    if (colour >= this->Figures.Stages.size()) // the colour's first partition
    {
      this->Figures.Stages.resize(colour);
      this->Figures.Stages.push_back({ 0, kept });
    }
    ++this->Figures.Stages[colour].ActivePartitions;
  }
  this->KeptTriangles -= all.Cells;
  if (owner == this->Ranks.rank())
  {
    this->Inboxes[std::size_t(p)].put(std::move(all));
    this->Started->setLoaded(p);
    return;
  }
  this->Ranks.post(owner, TaskMessage, packed(p, all));
}

/// Receives a partition to triangulate from its keeper.
template <typename Id>
void RankRun<Id>::receiveTask(const Message& message)
{
  LoadArchive reader(message.Content);
  const auto p = reader.get<PartitionIndex>();
  auto all = reader.get<VertexMessage>();
  if (p < 0 || std::size_t(p) >= this->Inboxes.size() || this->AwaitedTasks == 0 ||
    this->ownerOf(p) != this->Ranks.rank() || this->keeperOf(p) != message.Source)
  {
    throw std::runtime_error("A message from another rank is damaged: no such partition.");
  }
  --this->AwaitedTasks;
  this->Inboxes[std::size_t(p)].put(std::move(all));
  this->Started->setLoaded(p);
}

/// Collects the statistics. Collective.
template <typename Id>
void RankRun<Id>::keepFigures(const std::vector<Contribution>& parts)
{
  std::vector<double> seconds(this->Order->colourCount(), 0);
  for (const Contribution& part : parts)
  {
    std::transform(part.Seconds.begin(), part.Seconds.end(), seconds.begin(), seconds.begin(),
      std::plus<double>());
  }
  if (this->Options.Order == RankSchedule::Dynamic)
  {
    seconds = { std::accumulate(seconds.begin(), seconds.end(), 0.0) };
  }
  MasterStatistics whole;
  std::vector<double> longest(seconds.size(), 0);
  for (const std::vector<double>& other : this->Ranks.gather(seconds))
  {
    std::transform(other.begin(), other.end(), longest.begin(), longest.begin(),
      [](double a, double b) { return std::max(a, b); });
  }
  for (const MasterStatistics& other : this->Ranks.gather(this->Figures))
  {
    addStages(other.Stages, whole.Stages);
    whole.LargestMesh = std::max(whole.LargestMesh, other.LargestMesh);
  }
  whole.PathSeconds = std::accumulate(longest.begin(), longest.end(), 0.0);
  const bool isSingle = this->Work.majors() == 0;
  const int rank = this->Ranks.rank();
  std::vector<std::int32_t> group;
  for (const PartitionIndex p : this->Order->sequence())
  {
    if (this->keeperOf(p) == rank)
    {
      group.push_back(this->ownerOf(p));
    }
  }
  std::sort(group.begin(), group.end());
  this->Figures.Rank = rank;
  this->Figures.GroupSize = std::int32_t(std::unique(group.begin(), group.end()) - group.begin());
  (isSingle ? this->Statistics.MasterSeconds : this->Statistics.SubMasterSeconds) =
    this->Figures.Seconds;
  if (!isSingle && !group.empty())
  {
    const auto& areas = this->Work.Areas;
    const auto first = std::find_if(
      areas.begin() + 1, areas.end(), [rank](const Area& area) { return area.Lead == rank; });
    this->Figures.Area = std::int32_t(first - areas.begin());
    this->Masters.push_back(this->Figures);
  }
  if (rank == 0)
  {
    whole.GroupSize = isSingle ? this->Figures.GroupSize : std::int32_t(this->Ranks.size());
    whole.Seconds = isSingle ? this->Figures.Seconds : 0;
    this->Masters.push_back(std::move(whole));
  }
}

template class RankRun<std::int32_t>;
template class RankRun<std::int64_t>;

} // namespace tipp
