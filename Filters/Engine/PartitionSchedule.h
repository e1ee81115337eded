// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionSchedule_h
#define tippPartitionSchedule_h

#include "Engine/MetPartitions.h"
#include "Engine/PartitionIndex.h"
#include "vtkTIPPFiltersModule.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace tipp
{

/// An undirected graph: which partitions, or which pieces (sets of partitions), conflict.
class VTKTIPPFILTERS_EXPORT ConflictGraph
{
public:
  using Pair = std::pair<PartitionIndex, PartitionIndex>;

  /// A graph of `count` nodes without conflicts.
  explicit ConflictGraph(std::size_t count = 0)
    : Neighbours(count)
  {
  }

  /// A graph of known neighbours, each node's in ascending order.
  explicit ConflictGraph(std::vector<std::vector<PartitionIndex>> neighbours)
    : Neighbours(std::move(neighbours))
  {
    for (const auto& neighbours : this->Neighbours)
    {
      this->Count += neighbours.size();
    }
  }

  /// Adds conflicts; repetitions are allowed.
  void add(const std::vector<Pair>& pairs);

  std::size_t size() const { return this->Neighbours.size(); }
  /// The sum of all nodes' neighbour counts.
  std::size_t neighbourCount() const { return this->Count; }

  /// @name The neighbours of p: in ascending order, until the caller sorts them
  ///@{
  std::vector<PartitionIndex>& neighbours(PartitionIndex p)
  {
    return this->Neighbours[std::size_t(p)];
  }
  const std::vector<PartitionIndex>& neighbours(PartitionIndex p) const
  {
    return this->Neighbours[std::size_t(p)];
  }
  ///@}

  /// Returns each node's colour, counted from 0; conflicting nodes have different colours. Greedy,
  /// nodes with most conflicts first.
  std::vector<std::uint32_t> colours() const;

private:
  std::vector<std::vector<PartitionIndex>> Neighbours;
  std::size_t Count = 0;
};

/// Returns the conflicts of `partitions` partitions (Lemma 5, below). Returns nullopt if nearly all
/// conflict, as with co-circular points: the caller then treats all pairs as conflicting.
VTKTIPPFILTERS_EXPORT std::optional<ConflictGraph> findConflicts(
  const MetPartitions& initialMesh, std::size_t partitions);

/// The largest total number of neighbours for which findConflicts() returns a graph.
std::size_t mostConflicts(std::size_t partitions);

/// Which partitions conflict, and the order in which conflicting ones are triangulated. Both
/// depend only on the initial mesh, so every rank computes the same.
///
/// Lemma 5: P and Q conflict if one triangle of the initial mesh meets both, or of two triangles
/// with a common edge one meets P and the other Q. If they do not conflict, no disk that is empty
/// of the initial mesh's vertices meets both, now or later. (Proof. Grow the disk about its centre
/// until it touches a first vertex a. The centres of empty disks through a form a's Voronoi cell F;
/// those whose disk holds a point p of P form a half-plane H_p, and H_q likewise; F, H_p and H_q
/// have a point in common. If no vertex of F were in both half-planes, and no edge of F had an end
/// in each, then two vertices u, w of F in neither would lie between those in H_p and those in H_q,
/// and the line uw would separate H_p from H_q inside F: a contradiction. A vertex of F is a
/// triangle at a, an edge of F two triangles with a common edge. Where F is unbounded, no unbounded
/// direction helps inside the hull, which holds all regions.) So no later triangle and no later
/// edge joins them, and their workers commute. Additional conflicts are harmless.
///
/// Partitions are coloured; a colour is a stage of the dissertation. They are ordered by window, if
/// windows are given, then by colour and index. Windows may be chosen freely: the triangles do not
/// depend on the order.
class VTKTIPPFILTERS_EXPORT PartitionOrder
{
public:
  struct LaterPartitions
  {
    const PartitionIndex* First;
    const PartitionIndex* Last;

    const PartitionIndex* begin() const { return this->First; }
    const PartitionIndex* end() const { return this->Last; }
    std::size_t size() const { return std::size_t(this->Last - this->First); }
  };

  /// Orders the partitions that are to be triangulated. `isUsed` has one entry for each partition:
  /// 0 if it has no points.
  PartitionOrder(const std::vector<char>& isUsed, const MetPartitions& initialMesh)
    : PartitionOrder(isUsed, findConflicts(initialMesh, isUsed.size()))
  {
  }

  /// As above, with the conflicts given; nullopt: every partition conflicts with every other.
  PartitionOrder(const std::vector<char>& isUsed, std::optional<ConflictGraph> conflicts);

  /// Orders the partitions by window first. `windows` has one entry for each partition; empty: all
  /// are in one window.
  void setWindows(const std::vector<std::int32_t>& windows);

  /// The number of all partitions, used or not.
  std::size_t partitionCount() const { return this->Positions.size(); }

  /// All used partitions, in order.
  const std::vector<PartitionIndex>& sequence() const { return this->Sequence; }

  /// The same partitions by urgency: within a window, partitions that the longest chains of
  /// conflicting later partitions wait for come first, as in critical-path list scheduling.
  const std::vector<PartitionIndex>& byUrgency() const { return this->Urgency; }

  std::size_t position(PartitionIndex p) const { return this->Positions[std::size_t(p)]; }

  /// The conflicting partitions that come after p, in order.
  LaterPartitions later(PartitionIndex p) const;

  /// The first partition, in the order, of the non-empty range [begin, end).
  PartitionIndex first(const PartitionIndex* begin, const PartitionIndex* end) const;

  std::size_t colourCount() const { return this->ColourSizes.size(); }
  /// The number of partitions of a colour, counted from 0; partitions of a colour do not conflict.
  std::size_t colourSize(std::size_t colour) const { return this->ColourSizes[colour]; }
  std::size_t colourOf(PartitionIndex p) const { return this->Colours[std::size_t(p)]; }

  /// The conflicts; empty if isTotal().
  const ConflictGraph& conflicts() const { return this->Conflicts; }

  /// True if every partition counts as conflicting with every other.
  bool isTotal() const { return this->Total; }

private:
  void colour();
  void sortByUrgency(const std::vector<std::int32_t>& windows);

  std::vector<PartitionIndex> Sequence;
  std::vector<PartitionIndex> Urgency;
  std::vector<std::uint32_t> Positions;
  std::vector<std::uint32_t> Colours;
  std::vector<std::size_t> ColourSizes;
  ConflictGraph Conflicts;
  std::vector<std::size_t> EarlierCounts; ///< conflicting partitions before each
  bool Total = false;
};

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

  /// Returns a ready partition and waits until there is one. Returns NoPartition if all were handed
  /// out or the run was stopped.
  PartitionIndex take();

  /// Returns a ready partition, or NoPartition if none is ready now, all were handed out or the run
  /// was stopped.
  PartitionIndex tryTake();

  /// The number of partitions that were not handed out yet.
  std::size_t left() const { return this->NotTaken.load(std::memory_order_relaxed); }

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
  void countDown(PartitionIndex p);
  bool isOwn(PartitionIndex p) const { return this->Own.empty() || this->Own[std::size_t(p)]; }
  void release(PartitionIndex p);
  void releaseColour(std::size_t colour);

  const PartitionOrder& Order;
  const Waits Condition;
  const std::vector<char> Own;                    ///< empty: all
  std::vector<std::atomic<std::int32_t>> Awaited; ///< events each partition waits for
  std::vector<std::atomic<std::int64_t>> LeftInColour;
  std::vector<PartitionIndex> Urgency; ///< the partitions to hand out, the most urgent first
  std::vector<std::uint32_t> Ranks;    ///< by partition: its position in Urgency
  std::vector<std::atomic<std::uint64_t>> ReadyBits; ///< by position in Urgency
  std::atomic<std::size_t> NotTaken;                 ///< partitions not handed out yet
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
