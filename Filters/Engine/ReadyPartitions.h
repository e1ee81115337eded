// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadyPartitions_h
#define tippReadyPartitions_h

#include "Engine/PartitionOrder.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <vector>

namespace tipp
{

/// Hands partitions to threads as soon as they are ready: all conflicting partitions that come
/// before them in the order are done. Of those that are ready the most urgent is taken first.
/// Threads share counters and a bit for each partition, and no lock.
class ReadyPartitions
{
public:
  /// What else a partition waits for.
  enum class Waits
  {
    ForEarlier,        ///< nothing else
    ForEarlierAndLoad, ///< that setLoaded() is called
    ForColour,         ///< all partitions of the colour before; the order must have no windows
    ForLoad            ///< setLoaded() alone, and not for earlier ones
  };

  /// Hands out the partitions that `isOwn` has an entry other than 0 for; empty: all.
  ReadyPartitions(const PartitionOrder& order, Waits waits, std::vector<char> isOwn = {});

  /// A ready partition; waits for one. -1 if all were handed out or the run was stopped.
  PartitionIndex take();

  /// The same without waiting: -1 also if none is ready.
  PartitionIndex tryTake();

  /// The partition is done, one's own or another rank's, and what it sends is in the inboxes.
  void finish(PartitionIndex p);

  /// The points of a partition of this rank are in memory.
  void setLoaded(PartitionIndex p) { this->countDown(p); }

  /// No further partition is handed out. The first reason is kept.
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
  std::vector<std::atomic<std::int32_t>> Awaited; ///< of each partition: what it waits for
  std::vector<std::atomic<std::int64_t>> LeftInColour;
  std::vector<PartitionIndex> Urgency;               ///< those to hand out, the most urgent first
  std::vector<std::uint32_t> Ranks;                  ///< of each partition, its place there
  std::vector<std::atomic<std::uint64_t>> ReadyBits; ///< by place there
  std::atomic<std::size_t> Left;                     ///< not handed out yet
  std::atomic<bool> Stopped{ false };
  std::mutex FailureMutex;
  std::exception_ptr Failure;
};

} // namespace tipp

#endif
