// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadyPartitions_h
#define tippReadyPartitions_h

#include "Engine/PartitionOrder.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tipp
{

/// Hands out partitions to threads as soon as they are ready: when all conflicting partitions
/// before them in the order are done. The most urgent ready partition is taken first. Threads share
/// atomic counters and a bit for each partition, and no lock.
class ReadyPartitions
{
public:
  /// What a partition waits for.
  enum class Waits
  {
    ForEarlier,        ///< conflicting partitions before it
    ForEarlierAndLoad, ///< those, and setLoaded()
    ForColour,         ///< all partitions of the previous colour; the order must have no windows
    ForLoad            ///< setLoaded() only
  };

  /// Hands out the partitions whose entry in `isOwn` is not 0; all partitions if it is empty.
  /// `order` must outlive this object.
  ReadyPartitions(const PartitionOrder& order, Waits waits, std::vector<char> isOwn = {});

  /// Returns a ready partition and waits until there is one. Returns -1 if all were handed out or
  /// the run was stopped.
  PartitionIndex take();

  /// Returns a ready partition, or -1 if none is ready now, all were handed out or the run was
  /// stopped.
  PartitionIndex tryTake();

  /// Marks a partition of this or another rank as done. Call it when its messages are in the
  /// inboxes.
  void finish(PartitionIndex p);

  /// Marks the points of a partition of this rank as loaded.
  void setLoaded(PartitionIndex p) { this->countDown(p); }

  /// Stops handing out partitions. The first reason is kept.
  void stop(const std::exception_ptr& reason = nullptr);
  bool isStopped() const { return this->Stopped.load(std::memory_order_relaxed); }
  std::exception_ptr failure() const { return this->Failure; }

private:
  void awaitEarlier();
  void countColours();
  void countDown(PartitionIndex p);
  bool isOwn(PartitionIndex p) const { return this->Own.empty() || this->Own[std::size_t(p)]; }
  void release(PartitionIndex p);
  void releaseColour(std::size_t colour);

  const PartitionOrder& Order;
  const Waits For;
  const std::vector<char> Own;                    ///< empty: all
  std::vector<std::atomic<std::int32_t>> Awaited; ///< events each partition waits for
  std::vector<std::atomic<std::int64_t>> LeftInColour;
  std::vector<PartitionIndex> Urgency; ///< the partitions to hand out, the most urgent first
  std::vector<std::uint32_t> Ranks;    ///< by partition: its position in Urgency
  std::vector<std::atomic<std::uint64_t>> ReadyBits; ///< by position in Urgency
  std::atomic<std::size_t> Left;                     ///< partitions not handed out yet
  std::atomic<bool> Stopped{ false };
  std::mutex FailureMutex;
  std::exception_ptr Failure;
};

/// Calls work(thread) in this many threads, one of which is the caller's. If a call throws, no more
/// partitions are handed out, and the first exception is thrown when all threads have ended.
void runWorkers(ReadyPartitions& ready, int threads, const std::function<void(int thread)>& work);

/// Threads that are joined when the work ends, also by an exception.
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

} // namespace tipp

#endif
