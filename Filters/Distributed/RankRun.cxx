// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/RankRun.h"

#include "Arrays/SortUnique.h"
#include "Engine/DoneMessage.h"
#include "Engine/WorkerThreads.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <numeric>
#include <thread>
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

} // namespace

template <typename Id>
RankRun<Id>::RankRun(Communicator& ranks, const Plan& plan, OwnedPoints<Id>& points,
  const DistributedOptions& options, int threads)
  : InteriorCounts(static_cast<std::size_t>(plan.Leaves.size()), 0)
  , Ranks(ranks)
  , Work(plan)
  , Points(points)
  , Options(options)
  , Threads(threads)
  , FirstId(points.FirstIds[std::size_t(ranks.rank())])
  , Inboxes(static_cast<std::size_t>(plan.Leaves.size()))
{
}

/// Gathers the regions and initial points of all partitions on all ranks. Those of a partition come
/// from its owner.
template <typename Id>
void RankRun<Id>::shareInitialMesh(std::vector<BoundaryVertex>& vertices)
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
  const Bytes together = joinedOnAllRanks(this->Ranks, packed(regions, initial));
  std::vector<Box2> boxes(std::size_t(tiles.size()), Box2{});
  std::vector<char> used(std::size_t(tiles.size()), 0);
  for (LoadArchive reader(together); reader.left() > 0;)
  {
    for (const RegionEntry& entry : reader.get<std::vector<RegionEntry>>())
    {
      boxes.at(std::size_t(entry.Partition)) = entry.Box;
      used.at(std::size_t(entry.Partition)) = 1;
    }
    const auto added = reader.get<std::vector<BoundaryVertex>>();
    vertices.insert(vertices.end(), added.begin(), added.end());
  }
  this->Boxes = std::make_unique<Regions>(tiles, std::move(boxes), std::move(used));
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
  std::vector<BoundaryVertex> vertices;
  this->shareInitialMesh(vertices);
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
    SaveArchive writer;
    part.writeConflicts(writer);
    this->Order = std::make_unique<PartitionOrder>(this->Boxes->areUsed(),
      readConflicts(joinedOnAllRanks(this->Ranks, writer.take()), this->Keepers.size()));
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
  this->Ready = std::make_unique<ReadyPartitions>(
    *this->Order, hasBarriers ? Waits::ForColour : Waits::ForEarlier, this->thoseOf(this->Keepers));
  if (!isMasterless)
  {
    this->Started = std::make_unique<ReadyPartitions>(
      *this->Order, Waits::ForLoad, this->thoseOf(this->Work.Owners));
  }
  const int rank = this->Ranks.rank();
  for (const PartitionIndex p : this->Order->sequence())
  {
    const bool isOwn = this->ownerOf(p) == rank;
    const std::vector<std::int32_t> recipients = this->recipientsOf(p);
    const bool isTold = std::find(recipients.begin(), recipients.end(), rank) != recipients.end();
    this->LeftPartitions += isOwn ? 1 : 0;
    this->AwaitedTasks += isOwn && this->keeperOf(p) != rank ? 1 : 0;
    this->AwaitedMessages += !isOwn && isTold ? 1 : 0;
  }
}

/// The ranks that get a message when p is done.
template <typename Id>
std::vector<std::int32_t> RankRun<Id>::recipientsOf(PartitionIndex p) const
{
  std::vector<std::int32_t> ranks;
  if (this->hasMasters())
  {
    ranks.push_back(this->keeperOf(p));
  }
  for (const PartitionIndex q : this->Order->later(p))
  {
    ranks.push_back(this->keeperOf(q));
  }
  if (this->Options.Order != RankSchedule::Dynamic)
  {
    ranks.insert(ranks.end(), this->AllKeepers.begin(), this->AllKeepers.end());
  }
  sortUnique(ranks);
  return ranks;
}

/// Sends the triangles of this rank's part of the initial mesh to the inboxes that it keeps.
/// Triangles that meet no partition have artificial corners only, so none is final.
template <typename Id>
void RankRun<Id>::sendInitial(const BoundaryTriangles& part)
{
  FinalBoundary<std::int64_t> none;
  sendInitialMesh(
    part, *this->Order,
    [&](PartitionIndex to, VertexMessage&& message)
    {
      if (this->keeperOf(to) == this->Ranks.rank())
      {
        this->put(to, std::move(message));
      }
    },
    none);
}

template <typename Id>
void RankRun<Id>::put(PartitionIndex to, VertexMessage&& message)
{
  this->KeptTriangles += message.Triangles;
  this->Inboxes[std::size_t(to)].put(std::move(message));
}

/// A worker thread's loop.
template <typename Id>
void RankRun<Id>::work(Contribution& part)
{
  Worker<Id> worker(this->Work.Leaves, this->Points.Buckets, this->FirstId);
  Routing<Id> routing(*this->Order, *this->Boxes);
  UniqueVertices unique;
  part.Seconds.assign(this->Order->colourCount(), 0);
  ReadyPartitions& source = this->source();
  for (PartitionIndex p = source.take(); p >= 0; p = source.take())
  {
    const ProcessorWatch watch;
    routing.setPartition(p);
    worker.triangulate(
      p, unique.collect(this->Inboxes[std::size_t(p)].take()), (*this->Boxes)[p], routing);
    SentMessages sent;
    routing.send(
      worker,
      [&](PartitionIndex to, VertexMessage&& message)
      { sent.emplace_back(to, std::move(message)); },
      part.Boundary);
    this->InteriorCounts[std::size_t(p)] = worker.interiorCount();
    part.WorkerVertices += std::int64_t(worker.vertexCount());
    ++part.Partitions;
    part.Duplicates.insert(
      part.Duplicates.end(), worker.duplicates().begin(), worker.duplicates().end());
    part.Seconds[this->Order->colourOf(p)] += watch.seconds();
    this->finishPartition(p, std::move(sent));
  }
}

/// Adds messages to the inboxes on this rank, and queues those to other ranks for the main thread.
template <typename Id>
void RankRun<Id>::finishPartition(PartitionIndex p, SentMessages sent)
{
  const int rank = this->Ranks.rank();
  std::vector<Outgoing> outgoing;
  bool isWantedHere = false;
  for (const std::int32_t other : this->recipientsOf(p))
  {
    isWantedHere = isWantedHere || other == rank;
    if (other != rank)
    {
      outgoing.push_back({ other,
        writeDone(p, sent, [&](PartitionIndex to) { return this->keeperOf(to) == other; }) });
    }
  }
  for (auto& [to, message] : sent)
  {
    if (this->keeperOf(to) == rank)
    {
      this->put(to, std::move(message));
    }
  }
  this->PointsDone += this->Points.Buckets.count(p);
  {
    const std::lock_guard<std::mutex> lock(this->OutgoingMutex);
    std::move(outgoing.begin(), outgoing.end(), std::back_inserter(this->ToSend));
    if (isWantedHere && this->hasMasters())
    {
      this->DoneHere.push_back(p);
    }
  }
  if (!this->hasMasters())
  {
    this->Ready->finish(p);
  }
  --this->LeftPartitions;
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
  this->receiveDone(message);
  this->Figures.Seconds += watch.seconds();
}

/// Receives the message that another rank's partition is done, and what it sends to inboxes on this
/// rank.
template <typename Id>
void RankRun<Id>::receiveDone(const Message& message)
{
  PartitionIndex sender = -1;
  SentMessages sent = readDone<VertexMessage>(message.Content, this->Inboxes.size(), sender);
  const bool isGood = message.Kind == PartitionDoneMessage && this->AwaitedMessages > 0 &&
    this->ownerOf(sender) == message.Source &&
    std::all_of(sent.begin(), sent.end(),
      [this](const auto& to) { return this->keeperOf(to.first) == this->Ranks.rank(); });
  if (!isGood)
  {
    throw std::runtime_error("A message from another rank is damaged: it is for another one.");
  }
  for (auto& [to, vertices] : sent)
  {
    this->put(to, std::move(vertices));
  }
  --this->AwaitedMessages;
  this->finish(sender);
}

/// Marks a partition of this or another rank as done.
template <typename Id>
void RankRun<Id>::finish(PartitionIndex p)
{
  this->Ready->finish(p);
  if (this->hasMasters() && this->keeperOf(p) == this->Ranks.rank())
  {
    --this->InFlight[std::size_t(this->ownerOf(p))];
    --this->AllInFlight;
  }
}

/// Sends queued messages and receives arrived ones. Returns false if there were none.
template <typename Id>
bool RankRun<Id>::sendAndReceive()
{
  std::vector<Outgoing> outgoing;
  std::vector<PartitionIndex> done;
  {
    const std::lock_guard<std::mutex> lock(this->OutgoingMutex);
    outgoing.swap(this->ToSend);
    done.swap(this->DoneHere);
  }
  bool moved = !outgoing.empty() || !done.empty();
  for (Outgoing& message : outgoing)
  {
    this->Ranks.post(message.Rank, PartitionDoneMessage, std::move(message.Content));
  }
  for (const PartitionIndex p : done)
  {
    this->finish(p);
  }
  for (Message message; this->Ranks.poll(message); moved = true)
  {
    this->receive(message);
  }
  return (this->hasMasters() && this->startReady()) || moved;
}

template <typename Id>
void RankRun<Id>::report()
{
  this->SinceReport.restart();
  const double all = double(std::max<std::size_t>(1, this->Points.size()));
  if (this->Options.Progress && !this->Options.Progress(double(this->PointsDone) / all))
  {
    throw RankFailure(this->Ranks.rank(), true, "The run was stopped.");
  }
}

/// The main thread's loop; only this thread communicates with other ranks.
template <typename Id>
void RankRun<Id>::coordinate()
{
  // Sleeps, because polling takes processor time from computing threads.
  constexpr std::chrono::microseconds shortest(300);
  constexpr std::chrono::microseconds longest(2000);
  std::chrono::microseconds pause = shortest;
  constexpr double untilReport = 0.05;
  this->report();
  const auto isGoingOn = [this]()
  { return this->LeftPartitions > 0 || this->AwaitedMessages > 0 || this->AwaitedTasks > 0; };
  while (isGoingOn() && !this->source().isStopped())
  {
    if (this->sendAndReceive())
    {
      pause = shortest;
    }
    else
    {
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, longest);
    }
    if (this->SinceReport.seconds() > untilReport)
    {
      this->report();
    }
  }
  this->sendAndReceive();
  this->report();
}

/// Repairs the hull (Lemma 3). The first rank has the triangles at the hull.
template <typename Id>
void RankRun<Id>::repairHullOnFirst()
{
  std::vector<BoundaryVertex> vertices;
  for (const std::vector<BoundaryVertex>& part :
    this->Ranks.gather(std::exchange(this->Boundary.HullVertices, {})))
  {
    vertices.insert(vertices.end(), part.begin(), part.end());
  }
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
  const Stopwatch watch;
  {
    WorkerThreads threads(this->source());
    for (Contribution& part : parts)
    {
      threads.start([this, &part]() { this->work(part); });
    }
    this->coordinate();
  }
  if (this->source().failure())
  {
    std::rethrow_exception(this->source().failure());
  }
  const double seconds = watch.seconds();
  for (Contribution& part : parts)
  {
    this->Boundary.append(std::move(part.Boundary));
    this->Duplicates.insert(this->Duplicates.end(), part.Duplicates.begin(), part.Duplicates.end());
    this->Statistics.WorkerVertices += part.WorkerVertices;
    this->Statistics.Partitions += part.Partitions;
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

template class RankRun<std::int32_t>;
template class RankRun<std::int64_t>;

} // namespace tipp
