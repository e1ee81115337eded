// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/MasterlessRun.h"

#include "Distributed/MessageKinds.h"
#include "Parallel/ProcessorWatch.h"
#include "Triangulation/InitialMesh.h"
#include "Triangulation/PartitionSizes.h"

#include <algorithm>
#include <thread>

namespace tipp
{
namespace
{

/// Threads that end when the work ends, whatever ends it.
class WorkerThreads
{
public:
  explicit WorkerThreads(ReadyPartitions& ready)
    : Ready(ready)
  {
  }
  ~WorkerThreads()
  {
    this->Ready.stop();
    for (std::thread& thread : this->Threads)
    {
      thread.join();
    }
  }
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  template <typename Work>
  void start(const Work& work)
  {
    this->Threads.emplace_back(
      [this, work]()
      {
        try
        {
          work();
        }
        catch (...)
        {
          this->Ready.stop(std::current_exception());
        }
      });
  }

private:
  ReadyPartitions& Ready;
  std::vector<std::thread> Threads;
};

struct RegionEntry
{
  Box2 Box;
  PartitionIndex Partition;
};

} // namespace

template <typename Id>
MasterlessRun<Id>::MasterlessRun(Postbox& ranks, const Plan& plan, OwnedPoints<Id>& points,
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

/// Gathers all ranks' regions and initial points on all ranks.
template <typename Id>
void MasterlessRun<Id>::shareInitialMesh(std::vector<SeamVertex>& vertices)
{
  const Tiling& tiles = this->Work.Leaves;
  const Regions own(tiles, this->Points.Buckets, this->Threads);
  const int wanted = this->Options.InitialPointsPerPartition > 0
    ? this->Options.InitialPointsPerPartition
    : InitialPointsOfPartition;
  std::vector<SeamVertex> initial = chooseInitialPoints(tiles, this->Points.Buckets, wanted);
  std::vector<RegionEntry> regions;
  for (PartitionIndex p = 0; p < tiles.size(); ++p)
  {
    if (own.areUsed()[std::size_t(p)])
    {
      regions.push_back({ own[p], p });
    }
  }
  for (SeamVertex& v : initial)
  {
    v.Id += this->FirstId;
  }
  ByteWriter writer;
  writer.array(regions);
  write(writer, initial);
  ByteWriter all;
  for (const Bytes& part : this->Ranks.gather(writer.take()))
  {
    all.raw(part.data(), part.size());
  }
  const Bytes together = this->Ranks.broadcast(all.take());
  std::vector<Box2> boxes(std::size_t(tiles.size()), Box2{});
  std::vector<char> used(std::size_t(tiles.size()), 0);
  for (ByteReader reader(together); reader.left() > 0;)
  {
    for (const RegionEntry& entry : reader.array<RegionEntry>())
    {
      boxes.at(std::size_t(entry.Partition)) = entry.Box;
      used.at(std::size_t(entry.Partition)) = 1;
    }
    read(reader, vertices);
  }
  this->Boxes = std::make_unique<Regions>(tiles, std::move(boxes), std::move(used));
}

template <typename Id>
void MasterlessRun<Id>::makeInitialMesh()
{
  std::vector<SeamVertex> vertices;
  this->shareInitialMesh(vertices);
  this->Artificial = makeArtificialPoints(this->Work.Leaves);
  vertices.insert(vertices.end(), this->Artificial.begin(), this->Artificial.end());
  const SeamTriangles mesh = triangulateVertices(*this->Boxes, vertices, this->Threads);
  const bool chosen = this->Options.Minor.isGiven();
  this->PartitionsPay = !this->Artificial.empty() && (chosen || partitionsPay(mesh));
  if (!this->PartitionsPay)
  {
    return;
  }
  this->Order = std::make_unique<PartitionOrder>(this->Boxes->areUsed(), mesh);
  std::vector<char> isOwn(this->Order->partitionCount(), 0);
  for (std::size_t p = 0; p < isOwn.size(); ++p)
  {
    isOwn[p] = this->Work.Owners[p] == this->Ranks.rank() && this->Boxes->areUsed()[p];
    this->LeftPartitions += std::size_t(isOwn[p]);
  }
  for (const PartitionIndex p : this->Order->sequence())
  {
    const PartitionOrder::Range later = this->Order->later(p);
    this->AwaitedMessages += !isOwn[std::size_t(p)] &&
      std::any_of(
        later.begin(), later.end(), [&](PartitionIndex q) { return isOwn[std::size_t(q)] != 0; });
  }
  // Each rank makes the same messages and keeps those for its own partitions; the first one keeps
  // the triangles that are final already.
  FinalBoundary<std::int64_t> final;
  sendInitialMesh(
    mesh, *this->Order,
    [&](PartitionIndex to, VertexMessage&& message)
    {
      if (isOwn[std::size_t(to)])
      {
        this->Inboxes[std::size_t(to)].put(std::move(message));
      }
    },
    final);
  if (this->Ranks.rank() == 0)
  {
    this->Boundary = std::move(final);
  }
  this->Ready = std::make_unique<ReadyPartitions>(*this->Order, isOwn);
}

/// One thread's work.
template <typename Id>
void MasterlessRun<Id>::work(Contribution& part)
{
  Worker<Id> worker(this->Work.Leaves, this->Points.Buckets, this->FirstId);
  Routing<Id> routing(*this->Order, *this->Boxes);
  UniqueVertices unique;
  for (PartitionIndex p = this->Ready->take(); p >= 0; p = this->Ready->take())
  {
    const ProcessorWatch watch;
    routing.setPartition(p);
    worker.triangulate(
      p, unique.collect(this->Inboxes[std::size_t(p)].take()), (*this->Boxes)[p], routing);
    std::vector<std::pair<PartitionIndex, VertexMessage>> sent;
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
    this->finishPartition(p, std::move(sent));
    part.Seconds += watch.seconds();
  }
}

/// Puts messages to own partitions into their inboxes and hands those to other ranks to the main
/// thread.
template <typename Id>
void MasterlessRun<Id>::finishPartition(
  PartitionIndex p, std::vector<std::pair<PartitionIndex, VertexMessage>> sent)
{
  const int rank = this->Ranks.rank();
  const auto ownerOf = [this](PartitionIndex q) { return int(this->Work.Owners[std::size_t(q)]); };
  std::vector<int> others;
  for (const PartitionIndex q : this->Order->later(p))
  {
    if (ownerOf(q) != rank)
    {
      others.push_back(ownerOf(q));
    }
  }
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  std::vector<Outgoing> outgoing;
  for (const int other : others)
  {
    ByteWriter writer;
    writer.value(p);
    for (const auto& [to, message] : sent)
    {
      if (ownerOf(to) == other)
      {
        writer.value(to);
        write(writer, message);
      }
    }
    outgoing.push_back({ other, writer.take() });
  }
  for (auto& [to, message] : sent)
  {
    if (ownerOf(to) == rank)
    {
      this->Inboxes[std::size_t(to)].put(std::move(message));
    }
  }
  this->PointsDone += this->Points.Buckets.count(p);
  if (!outgoing.empty())
  {
    const std::lock_guard<std::mutex> lock(this->OutgoingMutex);
    std::move(outgoing.begin(), outgoing.end(), std::back_inserter(this->ToSend));
  }
  this->Ready->finish(p);
  --this->LeftPartitions;
}

/// Of another rank: a partition is done, and what it sends to partitions of this rank.
template <typename Id>
void MasterlessRun<Id>::receive(const Message& message)
{
  ByteReader reader(message.Content);
  const auto sender = reader.value<PartitionIndex>();
  const auto isPartition = [this](PartitionIndex p)
  { return p >= 0 && std::size_t(p) < this->Inboxes.size(); };
  bool isGood = message.Kind == PartitionDoneMessage && this->AwaitedMessages > 0 &&
    isPartition(sender) && this->Work.Owners[std::size_t(sender)] == message.Source;
  while (isGood && reader.left() > 0)
  {
    const auto to = reader.value<PartitionIndex>();
    VertexMessage vertices;
    read(reader, vertices);
    isGood = vertices.Sender == sender && isPartition(to) &&
      this->Work.Owners[std::size_t(to)] == this->Ranks.rank();
    if (isGood)
    {
      this->Inboxes[std::size_t(to)].put(std::move(vertices));
    }
  }
  if (!isGood)
  {
    throw std::runtime_error("A message from another rank is damaged: no such partition.");
  }
  --this->AwaitedMessages;
  this->Ready->finish(sender);
}

/// False if there was nothing to do.
template <typename Id>
bool MasterlessRun<Id>::sendAndReceive()
{
  std::vector<Outgoing> outgoing;
  {
    const std::lock_guard<std::mutex> lock(this->OutgoingMutex);
    outgoing.swap(this->ToSend);
  }
  bool moved = !outgoing.empty();
  for (Outgoing& message : outgoing)
  {
    this->Ranks.post(message.Rank, PartitionDoneMessage, std::move(message.Content));
  }
  for (Message message; this->Ranks.poll(message); moved = true)
  {
    this->receive(message);
  }
  return moved;
}

template <typename Id>
void MasterlessRun<Id>::report()
{
  this->SinceReport.restart();
  const double all = double(std::max<std::size_t>(1, this->Points.size()));
  if (this->Options.Progress && !this->Options.Progress(double(this->PointsDone) / all))
  {
    throw RankFailure(this->Ranks.rank(), true, "The run was stopped.");
  }
}

/// The main thread, which alone speaks to other ranks.
template <typename Id>
void MasterlessRun<Id>::coordinate()
{
  // Looking for messages takes the processor from a thread that computes.
  constexpr auto pause = std::chrono::microseconds(300);
  constexpr double untilReport = 0.05;
  this->report();
  while (this->LeftPartitions > 0 && !this->Ready->isStopped())
  {
    if (!this->sendAndReceive())
    {
      std::this_thread::sleep_for(pause);
    }
    if (this->SinceReport.seconds() > untilReport)
    {
      this->report();
    }
  }
  this->sendAndReceive();
  this->report();
}

/// Lemma 3. The first rank has the triangles at the hull.
template <typename Id>
void MasterlessRun<Id>::repairHullOnFirst()
{
  ByteWriter writer;
  write(writer, this->Boundary.HullVertices);
  this->Boundary.HullVertices.clear();
  for (const Bytes& part : this->Ranks.gather(writer.take()))
  {
    ByteReader reader(part);
    read(reader, this->Boundary.HullVertices);
  }
  if (this->Ranks.rank() == 0)
  {
    repairHull(this->Boundary, this->Artificial);
  }
}

template <typename Id>
void MasterlessRun<Id>::run()
{
  this->makeInitialMesh();
  if (!this->PartitionsPay)
  {
    return;
  }
  std::vector<Contribution> parts(std::size_t(this->Threads));
  const Stopwatch watch;
  {
    WorkerThreads threads(*this->Ready);
    for (Contribution& part : parts)
    {
      threads.start([this, &part]() { this->work(part); });
    }
    this->coordinate();
  }
  if (this->Ready->failure())
  {
    std::rethrow_exception(this->Ready->failure());
  }
  const double seconds = watch.seconds();
  for (Contribution& part : parts)
  {
    this->Boundary.append(std::move(part.Boundary));
    this->Duplicates.insert(this->Duplicates.end(), part.Duplicates.begin(), part.Duplicates.end());
    this->Statistics.WorkerVertices += part.WorkerVertices;
    this->Statistics.Partitions += part.Partitions;
    this->Statistics.ComputeSeconds += part.Seconds;
  }
  this->Statistics.WaitSeconds =
    std::max(0.0, seconds - this->Statistics.ComputeSeconds / this->Threads);
  this->repairHullOnFirst();
  for (const auto& triangle : this->Boundary.Triangles)
  {
    this->Kept.push_back(triangle.Ids);
  }
}

template class MasterlessRun<std::int32_t>;
template class MasterlessRun<std::int64_t>;

} // namespace tipp
