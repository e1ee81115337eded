// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed3D/RankRun3.h"

#include "Arrays/SortUnique.h"
#include "Distributed/RankRun.h"
#include "Engine/DoneMessage.h"
#include "Engine/WorkerThreads.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

namespace tipp
{
namespace
{

/// The pause between looks for messages from other ranks.
constexpr std::chrono::microseconds ShortPause(500);

/// Returns for each partition whether this rank owns it and it has points.
std::vector<char> ownPartitions(const Communicator& ranks, const RankWork3& work)
{
  std::vector<char> isOwn(work.Order.partitionCount(), 0);
  for (const PartitionIndex p : work.Order.sequence())
  {
    isOwn[std::size_t(p)] = work.ownerOf(p) == ranks.rank();
  }
  return isOwn;
}

} // namespace

/// Sorts the final tetrahedra of one thread.
struct RankRun3::Cells : public FinalCellConsumer3
{
  explicit Cells(const RankRun3& run)
    : First(run.FirstId)
    , End(run.FirstId + std::int64_t(run.Points.Points.size()))
  {
  }

  void addInside(const std::array<std::int64_t, 4>& ids) override
  {
    this->Inside.push_back(
      { this->local(ids[0]), this->local(ids[1]), this->local(ids[2]), this->local(ids[3]) });
  }

  void add(const std::array<Vertex3, 4>& corners) override
  {
    if (takeHullVertices(corners, this->HullVertices))
    {
      return;
    }
    const IdCell<4> ids = { corners[0].Id, corners[1].Id, corners[2].Id, corners[3].Id };
    const bool isInside = std::all_of(ids.begin(), ids.end(),
      [this](std::int64_t id) { return this->First <= id && id < this->End; });
    isInside ? this->addInside(ids) : this->Kept.push_back(ids);
  }

  std::int32_t local(std::int64_t id) const { return std::int32_t(id - this->First); }

  const std::int64_t First;
  const std::int64_t End;
  std::vector<CellIds> Inside;
  std::vector<IdCell<4>> Kept;
  std::vector<Vertex3> HullVertices;
};

RankRun3::RankRun3(
  Communicator& ranks, const RankWork3& work, const PointBuckets3& points, std::int64_t firstId)
  : Ranks(ranks)
  , Work(work)
  , Points(points)
  , FirstId(firstId)
  , Ready(work.Order, ReadyPartitions::Waits::ForEarlier, ownPartitions(ranks, work))
  , IsReady(work.Order.partitionCount())
  , Inboxes(work.Order.partitionCount())
{
  for (const PartitionIndex p : work.Order.sequence())
  {
    const bool isOwn = work.ownerOf(p) == ranks.rank();
    const std::vector<std::int32_t> to = this->recipientsOf(p);
    isOwn ? this->OwnPartitions.push_back(p) : void();
    this->AwaitedMessages +=
      !isOwn && std::find(to.begin(), to.end(), ranks.rank()) != to.end() ? 1 : 0;
  }
  this->LeftPartitions = this->OwnPartitions.size();
  this->LeftToTake = this->OwnPartitions.size();
  this->Statistics.Partitions = std::int64_t(this->OwnPartitions.size());
}

/// Returns the ranks that wait for partition p.
std::vector<std::int32_t> RankRun3::recipientsOf(PartitionIndex p) const
{
  std::vector<std::int32_t> ranks;
  for (const PartitionIndex q : this->Work.Order.later(p))
  {
    ranks.push_back(this->Work.ownerOf(q));
  }
  sortUnique(ranks);
  return ranks;
}

/// As ReadyPartitions::take(), but with longer pauses, because messages from other ranks take time.
PartitionIndex RankRun3::take()
{
  PartitionIndex p = -1;
  ++this->Idle;
  while (this->LeftToTake > 0 && !this->Ready.isStopped())
  {
    p = this->Ready.tryTake();
    if (p >= 0)
    {
      --this->LeftToTake;
      break;
    }
    std::this_thread::sleep_for(ShortPause);
  }
  --this->Idle;
  return p;
}

/// Wakes the threads that wait for partitions to be done.
void RankRun3::notify()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex); // waiting threads check with it locked
  }
  this->Changed.notify_all();
}

/// Waits until a partition that this thread has begun is ready. Returns false if the run was
/// stopped.
bool RankRun3::waitFor(PartitionIndex p)
{
  constexpr std::chrono::milliseconds pause(10);
  ++this->Idle;
  std::unique_lock<std::mutex> lock(this->Mutex);
  while (this->IsReady[std::size_t(p)] == 0 && !this->Ready.isStopped())
  {
    const PartitionIndex ready = this->Ready.tryTake();
    if (ready >= 0)
    {
      this->IsReady[std::size_t(ready)] = 1;
      this->Changed.notify_all(); // its thread may be another one
    }
    else
    {
      this->Changed.wait_for(lock, pause);
    }
  }
  --this->Idle;
  return this->IsReady[std::size_t(p)] != 0 && !this->Ready.isStopped();
}

/// The loop of a worker thread.
void RankRun3::work(Cells& cells)
{
  const ProcessorWatch watch;
  Worker3 worker(this->Points.Regions, this->Work.Order);
  const auto inboxOf = [this](PartitionIndex p) { return this->Inboxes[std::size_t(p)].take(); };
  if (this->OwnPartitions.size() <= std::size_t(this->Work.Threads))
  {
    // No thread has anything else to do until its partition is ready.
    const std::size_t next = this->NextOwn++;
    if (next < this->OwnPartitions.size())
    {
      const PartitionIndex p = this->OwnPartitions[next];
      std::size_t inserted = 0;
      worker.begin(this->Points.of(p, this->FirstId),
        [&](std::size_t now)
        {
          this->PointsDone += now - std::exchange(inserted, now);
          return !this->Ready.isStopped();
        });
      if (this->waitFor(p))
      {
        this->PointsDone -= inserted;
        this->finish(p, worker.finish(inboxOf(p), cells));
      }
    }
  }
  else
  {
    for (PartitionIndex p = this->take(); p >= 0; p = this->take())
    {
      this->finish(p, worker.triangulate(this->Points.of(p, this->FirstId), inboxOf(p), cells));
    }
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Statistics.WorkerVertices += std::int64_t(worker.vertexCount());
  this->Statistics.ComputeSeconds += watch.seconds();
  this->Duplicates.insert(
    this->Duplicates.end(), worker.duplicates().begin(), worker.duplicates().end());
}

/// Adds a finished partition's messages to the inboxes on this rank, and queues those for other
/// ranks, which the main thread sends.
void RankRun3::finish(PartitionIndex p, SentMessages3&& sent)
{
  std::vector<Outgoing> outgoing;
  for (const std::int32_t rank : this->recipientsOf(p))
  {
    if (rank != this->Ranks.rank())
    {
      outgoing.push_back({ rank,
        writeDone(p, sent, [&](PartitionIndex to) { return this->Work.ownerOf(to) == rank; }) });
    }
  }
  for (auto& [to, message] : sent)
  {
    if (this->Work.ownerOf(to) == this->Ranks.rank())
    {
      this->Inboxes[std::size_t(to)].put(std::move(message));
    }
  }
  this->PointsDone += this->Points.count(p);
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::move(outgoing.begin(), outgoing.end(), std::back_inserter(this->ToSend));
  }
  this->Ready.finish(p);
  --this->LeftPartitions;
  this->notify();
}

/// Handles the message that a partition of another rank is done.
void RankRun3::receive(const Message& message)
{
  PartitionIndex sender = -1;
  SentMessages3 sent = readDone<VertexMessage3>(message.Content, this->Inboxes.size(), sender);
  const bool isGood = message.Kind == PartitionDoneMessage && this->AwaitedMessages > 0 &&
    this->Work.ownerOf(sender) == message.Source &&
    std::all_of(sent.begin(), sent.end(),
      [this](const auto& to) { return this->Work.ownerOf(to.first) == this->Ranks.rank(); });
  if (!isGood)
  {
    throw std::runtime_error("A message from another rank is damaged: it is for another one.");
  }
  for (auto& [to, vertices] : sent)
  {
    this->Inboxes[std::size_t(to)].put(std::move(vertices));
  }
  --this->AwaitedMessages;
  this->Ready.finish(sender);
  this->notify();
}

/// Returns false if there was nothing to send or receive.
bool RankRun3::sendAndReceive()
{
  std::vector<Outgoing> outgoing;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    outgoing.swap(this->ToSend);
  }
  bool isMoving = !outgoing.empty();
  for (Outgoing& message : outgoing)
  {
    this->Ranks.post(message.Rank, PartitionDoneMessage, std::move(message.Content));
  }
  for (Message message; this->Ranks.poll(message); isMoving = true)
  {
    this->receive(message);
  }
  return isMoving;
}

void RankRun3::report()
{
  this->SinceReport.restart();
  const double all = double(std::max<std::size_t>(1, this->Points.Points.size()));
  if (this->Work.Options.Progress && !this->Work.Options.Progress(double(this->PointsDone) / all))
  {
    throw RankFailure(this->Ranks.rank(), true, "The run was stopped.");
  }
}

/// The loop of the main thread. Only this thread communicates with other ranks.
void RankRun3::coordinate()
{
  // Polling takes processor time from the computing threads. So it is frequent only while one of
  // them waits for other ranks, or all are done.
  constexpr std::chrono::microseconds longest(5000);
  constexpr double untilReport = 0.05;
  this->report();
  while ((this->LeftPartitions > 0 || this->AwaitedMessages > 0) && !this->Ready.isStopped())
  {
    if (!this->sendAndReceive())
    {
      const bool areWaiting = this->Idle > 0 || this->LeftPartitions == 0;
      std::unique_lock<std::mutex> lock(this->Mutex);
      if (this->ToSend.empty())
      {
        this->Changed.wait_for(lock, areWaiting ? ShortPause : longest);
      }
    }
    if (this->SinceReport.seconds() > untilReport)
    {
      this->report();
    }
  }
  this->sendAndReceive();
  this->report();
}

void RankRun3::run(std::vector<VertexMessage3> initial)
{
  for (std::size_t p = 0; p < initial.size(); ++p)
  {
    if (this->Work.ownerOf(PartitionIndex(p)) == this->Ranks.rank())
    {
      this->Inboxes[p].put(std::move(initial[p]));
    }
  }
  std::vector<Cells> parts(std::size_t(this->Work.Threads), Cells(*this));
  constexpr std::size_t cellsOfPoint = 7;
  for (Cells& cells : parts)
  {
    cells.Inside.reserve(cellsOfPoint * this->Points.Points.size() / parts.size());
  }
  const Stopwatch watch;
  {
    WorkerThreads threads(this->Ready);
    for (Cells& cells : parts)
    {
      threads.start([this, &cells]() { this->work(cells); });
    }
    this->coordinate();
  }
  if (this->Ready.failure())
  {
    std::rethrow_exception(this->Ready.failure());
  }
  this->Statistics.WaitSeconds =
    std::max(0.0, watch.seconds() - this->Statistics.ComputeSeconds / this->Work.Threads);
  for (Cells& cells : parts)
  {
    this->Inside.push_back(std::move(cells.Inside));
    this->Kept.insert(this->Kept.end(), cells.Kept.begin(), cells.Kept.end());
    this->HullVertices.insert(
      this->HullVertices.end(), cells.HullVertices.begin(), cells.HullVertices.end());
  }
  keepUnique(this->HullVertices);
}

} // namespace tipp
