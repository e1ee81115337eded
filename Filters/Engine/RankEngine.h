// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankEngine_h
#define tippRankEngine_h

#include "Engine/Inbox.h"
#include "Engine/PartitionSchedule.h"
#include "Parallel/Sort.h"
#include "Parallel/Stopwatch.h"
#include "Ranks/Communicator.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// A partition is done; with the messages that it sends.
constexpr MessageKind PartitionDoneMessage = kindAfter(0);
/// With masters: a partition to triangulate, with its inbox.
constexpr MessageKind TaskMessage = kindAfter(1);

/// A rank's part of a triangulation in the plane or in space, in memory or out of core: the rank
/// triangulates the partitions whose points it owns. This base class has the partitions' inboxes,
/// and exchanges messages about finished partitions with other ranks, if there are any.
/// `SentMessage` has the vertices for one inbox.
///
/// One rank, the *keeper*, stores a partition's inbox, receives a message when each partition that
/// this one waits for is done, and then starts it. By default it is the owner of the partition's
/// points.
///
/// A finished partition is one message to each rank that keeps its inbox or that of a later
/// conflicting partition: it contains the vertices for these, and marks the partition as done. A
/// rank has finished when all partitions that it owns or keeps are done; no termination protocol is
/// needed. Results do not depend on when messages arrive.
template <typename SentMessage>
class RankEngine
{
protected:
  using Sent = std::vector<std::pair<PartitionIndex, SentMessage>>;

  /// The interval between polls for messages while threads wait for other ranks.
  static constexpr std::chrono::microseconds ShortPause{ 300 };

  /// `points`: the number of points that PointsDone counts up to. `progress`: called with the
  /// finished fraction of these; may be empty. `ranks` and `progress` must outlive this object.
  RankEngine(Communicator& ranks, std::size_t partitions, std::size_t points,
    const std::function<bool(double)>& progress)
    : Ranks(ranks)
    , Inboxes(partitions)
    , PointCount(std::max<std::size_t>(1, points))
    , Progress(progress)
  {
  }
  virtual ~RankEngine() = default;

  virtual std::int32_t ownerOf(PartitionIndex p) const = 0;
  virtual std::int32_t keeperOf(PartitionIndex p) const { return this->ownerOf(p); }

  /// Returns the ranks that get a message when p is done, ascending.
  virtual std::vector<std::int32_t> recipientsOf(PartitionIndex p) const
  {
    std::vector<std::int32_t> ranks;
    for (const PartitionIndex q : this->Order->later(p))
    {
      ranks.push_back(this->keeperOf(q));
    }
    sortUnique(ranks);
    return ranks;
  }

  /// The queue from which threads take partitions.
  virtual ReadyPartitions& source() = 0;
  virtual void put(PartitionIndex to, SentMessage&& message)
  {
    this->Inboxes[std::size_t(to)].put(std::move(message));
  }
  /// Marks a partition as done; called by the main thread when another rank has triangulated it.
  virtual void setDone(PartitionIndex p) { this->source().finish(p); }
  /// Marks a partition of this rank as done; called by the thread that triangulated it.
  virtual void setDoneHere(PartitionIndex p) { this->source().finish(p); }
  /// Called by the main thread after it has received messages. Returns false if there was nothing
  /// to do.
  virtual bool startPartitions() { return false; }
  /// Returns whether messages must be handled soon, even if all threads of this rank are busy.
  virtual bool areOthersWaiting() const { return false; }
  /// Returns whether this rank has triangulated its partitions and needs no more messages.
  virtual bool isFinished() const
  {
    return this->LeftPartitions == 0 && this->AwaitedMessages == 0;
  }

  /// Sets the order of the partitions, and counts what this rank waits for. `order` must outlive
  /// this object. `left`: the partitions that are not done yet.
  void begin(const PartitionOrder& order, const std::vector<PartitionIndex>& left)
  {
    this->Order = &order;
    const int rank = this->Ranks.rank();
    for (const PartitionIndex p : left)
    {
      const bool isOwn = this->ownerOf(p) == rank;
      const std::vector<std::int32_t> to = this->recipientsOf(p);
      const bool isTold = std::binary_search(to.begin(), to.end(), rank);
      this->LeftPartitions += isOwn ? 1 : 0;
      this->AwaitedMessages += !isOwn && isTold ? 1 : 0;
    }
  }

  /// Calls work(part) in a thread for each part, and communicates until all partitions are done.
  /// Returns the seconds that took.
  template <typename Part, typename Work>
  double runThreads(std::vector<Part>& parts, const Work& work)
  {
    const Stopwatch watch;
    {
      WorkerThreads threads(this->source());
      for (Part& part : parts)
      {
        threads.start([&work, &part]() { work(part); });
      }
      this->coordinate();
    }
    if (this->source().failure())
    {
      std::rethrow_exception(this->source().failure());
    }
    return watch.seconds();
  }

  /// Returns a partition to triangulate, or NoPartition if there is none left.
  PartitionIndex take()
  {
    ++this->Idle;
    const PartitionIndex p = this->source().take();
    --this->Idle;
    return p;
  }

  /// Adds a finished partition's messages to the inboxes on this rank, and queues those for other
  /// ranks, which the main thread sends. `points`: the partition's number of points.
  void finish(PartitionIndex p, Sent&& sent, std::size_t points)
  {
    const int rank = this->Ranks.rank();
    for (const std::int32_t other : this->recipientsOf(p))
    {
      if (other == rank)
      {
        continue;
      }
      SaveArchive writer;
      writer(p);
      for (const auto& [to, message] : sent)
      {
        if (this->keeperOf(to) == other)
        {
          writer(to, message);
        }
      }
      this->queue(other, PartitionDoneMessage, writer.take());
    }
    for (auto& [to, message] : sent)
    {
      if (this->keeperOf(to) == rank)
      {
        this->put(to, std::move(message));
      }
    }
    this->PointsDone += points;
    this->setDoneHere(p);
    --this->LeftPartitions;
    this->notify();
  }

  /// Queues a message, which the main thread sends.
  void queue(int to, MessageKind kind, Bytes content)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->ToSend.push_back({ to, kind, std::move(content) });
  }

  /// Handles the message that a partition of another rank is done.
  virtual void receive(const Message& message)
  {
    LoadArchive reader(message.Content);
    const auto require = [](bool isGood, const char* problem)
    {
      if (!isGood)
      {
        throw std::runtime_error(
          std::string("A message from another rank is damaged: ") + problem + ".");
      }
    };
    const auto isPartition = [this](PartitionIndex p)
    { return p >= 0 && std::size_t(p) < this->Inboxes.size(); };
    const auto sender = reader.get<PartitionIndex>();
    require(isPartition(sender), "no such partition");
    Sent sent;
    while (reader.left() > 0)
    {
      sent.emplace_back(reader.get<PartitionIndex>(), SentMessage{});
      require(isPartition(sent.back().first), "no such partition");
      reader(sent.back().second);
      require(sent.back().second.Sender == sender, "no such partition");
    }
    require(message.Kind == PartitionDoneMessage && this->AwaitedMessages > 0 &&
        this->ownerOf(sender) == message.Source &&
        std::all_of(sent.begin(), sent.end(),
          [this](const auto& to) { return this->keeperOf(to.first) == this->Ranks.rank(); }),
      "it is for another one");
    for (auto& [to, vertices] : sent)
    {
      this->put(to, std::move(vertices));
    }
    --this->AwaitedMessages;
    this->setDone(sender);
    this->notify();
  }

  Communicator& Ranks;
  const PartitionOrder* Order = nullptr;
  std::vector<MessageInbox<SentMessage>> Inboxes;
  std::size_t AwaitedMessages = 0;              ///< of other ranks' finished partitions
  std::atomic<std::size_t> LeftPartitions{ 0 }; ///< partitions of this rank that are not done
  std::atomic<std::size_t> PointsDone{ 0 };
  std::atomic<int> Idle{ 0 };      ///< threads that wait for a partition
  std::condition_variable Changed; ///< signalled when a partition is done, here or on another rank
  std::mutex Mutex;                ///< protects ToSend, Statistics, and results when a thread ends

private:
  /// A message to another rank.
  struct Outgoing
  {
    int Rank;
    MessageKind Kind;
    Bytes Content;
  };

  void notify()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex); // waiting threads check with it locked
    }
    this->Changed.notify_all();
  }

  /// Sends the queued messages. Returns false if there are none.
  bool send()
  {
    std::vector<Outgoing> outgoing;
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      outgoing.swap(this->ToSend);
    }
    for (Outgoing& message : outgoing)
    {
      this->Ranks.post(message.Rank, message.Kind, std::move(message.Content));
    }
    return !outgoing.empty();
  }

  /// Returns false if there was nothing to do.
  bool sendAndReceive()
  {
    bool moved = this->send();
    for (Message message; this->Ranks.poll(message); moved = true)
    {
      this->receive(message);
    }
    return this->startPartitions() || moved;
  }

  /// The loop of the main thread. Only this thread communicates with other ranks.
  void coordinate()
  {
    // Polling takes processor time from the computing threads. So it is frequent only while one of
    // them waits for other ranks, or all are done.
    constexpr std::chrono::microseconds longest(5000);
    constexpr double untilReport = 0.05;
    constexpr double untilChange = 0.005; // a change is reported sooner
    this->report();
    while (!this->isFinished() && !this->source().isStopped())
    {
      if (!this->sendAndReceive())
      {
        const bool areWaiting =
          this->Idle > 0 || this->LeftPartitions == 0 || this->areOthersWaiting();
        std::unique_lock<std::mutex> lock(this->Mutex);
        if (this->ToSend.empty())
        {
          this->Changed.wait_for(lock, areWaiting ? ShortPause : longest);
        }
      }
      const bool isChanged = this->PointsDone != this->PointsReported;
      if (this->SinceReport.seconds() > (isChanged ? untilChange : untilReport))
      {
        this->report();
      }
    }
    this->send();
    this->report();
  }

  void report()
  {
    this->SinceReport.restart();
    this->PointsReported = this->PointsDone;
    const double done = double(this->PointsReported) / double(this->PointCount);
    if (this->Progress && !this->Progress(done))
    {
      throw RankFailure(this->Ranks.rank(), true, "The run was stopped.");
    }
  }

  const std::size_t PointCount;
  const std::function<bool(double)>& Progress;
  std::vector<Outgoing> ToSend;
  std::size_t PointsReported = 0;
  Stopwatch SinceReport;
};

} // namespace tipp

#endif
