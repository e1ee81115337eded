// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankRun3_h
#define tippRankRun3_h

#include "Distributed/DistributedStatistics.h"
#include "Engine/RankEngine.h"
#include "Triangulation3D/Dataflow3.h"
#include "Triangulation3D/OrderCells.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <mutex>
#include <utility>
#include <vector>

namespace tipp
{

/// The parts of a run that are the same on all ranks.
struct RankWork3
{
  const Tiling3& Tiling;       ///< each rank owns one of its groups of partitions
  const PartitionOrder& Order; ///< computed by each rank from the same initial mesh
  const std::vector<Vertex3>& Artificial;
  const TetrahedralizationOptions& Options;
  int Threads;

  int ownerOf(PartitionIndex p) const { return this->Tiling.groupOf(p); }
};

/// A rank's part of a triangulation in space.
class RankRun3 : public RankEngine<VertexMessage3>
{
public:
  /// `points`: the points of this rank's partitions, and the regions of all partitions. Internal
  /// ids are the ids in `points` plus `firstId`. All references must outlive this object.
  RankRun3(
    Communicator& ranks, const RankWork3& work, const PointBuckets3& points, std::int64_t firstId)
    : RankEngine(ranks, work.Order.partitionCount(), points.Points.size(), work.Options.Progress)
    , Work(work)
    , Points(points)
    , FirstId(firstId)
    , Ready(work.Order, ReadyPartitions::Waits::ForEarlier, ownPartitions(ranks, work))
    , IsReady(work.Order.partitionCount())
  {
    std::copy_if(work.Order.sequence().begin(), work.Order.sequence().end(),
      std::back_inserter(this->OwnPartitions),
      [&](PartitionIndex p) { return work.ownerOf(p) == ranks.rank(); });
    this->begin(work.Order, work.Order.sequence());
  }

  /// Runs the triangulation. `initial`: the messages of the initial mesh to all partitions.
  /// Collective. Throws RankFailure.
  void run(SentMessages3&& initial)
  {
    for (auto& [to, message] : initial)
    {
      if (this->Work.ownerOf(to) == this->Ranks.rank())
      {
        this->put(to, std::move(message));
      }
    }
    std::vector<Cells> parts(std::size_t(this->Work.Threads), Cells(*this));
    constexpr std::size_t cellsOfPoint = 7;
    for (Cells& cells : parts)
    {
      cells.Inside.reserve(cellsOfPoint * this->Points.Points.size() / parts.size());
    }
    const double seconds = this->runThreads(parts, [this](Cells& cells) { this->work(cells); });
    this->Statistics.WaitSeconds =
      std::max(0.0, seconds - this->Statistics.ComputeSeconds / this->Work.Threads);
    std::vector<Vertex3> hull;
    for (const Cells& cells : parts)
    {
      hull.insert(hull.end(), cells.HullVertices.begin(), cells.HullVertices.end());
    }
    keepUnique(hull);
    // The first rank has the tetrahedra at the hull (Lemma 3).
    hull = gatherList(this->Ranks, hull);
    if (this->Ranks.isFirst())
    {
      repairHull(std::move(hull), this->Work.Artificial, parts.front());
    }
    for (Cells& cells : parts)
    {
      this->Inside.push_back(std::move(cells.Inside));
      this->Kept.insert(this->Kept.end(), cells.Kept.begin(), cells.Kept.end());
    }
  }

  /// By thread: tetrahedra whose corners are all this rank's points, by indices of these.
  std::vector<std::vector<CellIds>> Inside;
  std::vector<IdCell<4>> Kept; ///< other tetrahedra that became final on this rank, by internal ids
  std::vector<Duplicate> Duplicates; ///< with internal ids
  RankStatistics Statistics;

private:
  /// Sorts the final tetrahedra of one thread.
  struct Cells : public FinalCellConsumer3
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

  /// Returns for each partition whether this rank owns it and it has points.
  static std::vector<char> ownPartitions(const Communicator& ranks, const RankWork3& work)
  {
    std::vector<char> isOwn(work.Order.partitionCount(), 0);
    for (const PartitionIndex p : work.Order.sequence())
    {
      isOwn[std::size_t(p)] = work.ownerOf(p) == ranks.rank();
    }
    return isOwn;
  }

  std::int32_t ownerOf(PartitionIndex p) const override { return this->Work.ownerOf(p); }
  ReadyPartitions& source() override { return this->Ready; }

  /// Waits until a partition that this thread has begun is ready. Returns false if the run was
  /// stopped.
  bool waitFor(PartitionIndex p)
  {
    constexpr std::chrono::milliseconds pause(10);
    ++this->Idle;
    std::unique_lock<std::mutex> lock(this->Mutex);
    while (this->IsReady[std::size_t(p)] == 0 && !this->Ready.isStopped())
    {
      const PartitionIndex ready = this->Ready.tryTake();
      if (ready != NoPartition)
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
  void work(Cells& cells)
  {
    const ProcessorWatch watch;
    Worker3 worker(this->Points.Regions, this->Work.Order);
    std::int64_t partitions = 0;
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
          this->finish(p, worker.finish(inboxOf(p), cells), this->Points.count(p));
          ++partitions;
        }
      }
    }
    else
    {
      for (PartitionIndex p = this->take(); p != NoPartition; p = this->take())
      {
        this->finish(p, worker.triangulate(this->Points.of(p, this->FirstId), inboxOf(p), cells),
          this->Points.count(p));
        ++partitions;
      }
    }
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Statistics.Partitions += partitions;
    this->Statistics.WorkerVertices += std::int64_t(worker.vertexCount());
    this->Statistics.ComputeSeconds += watch.seconds();
    this->Duplicates.insert(
      this->Duplicates.end(), worker.duplicates().begin(), worker.duplicates().end());
  }

  const RankWork3& Work;
  const PointBuckets3& Points;
  const std::int64_t FirstId;
  ReadyPartitions Ready;
  std::vector<std::atomic<char>> IsReady;    ///< by partition, if a thread has begun it
  std::vector<PartitionIndex> OwnPartitions; ///< in the order of work
  std::atomic<std::size_t> NextOwn{ 0 };
};

} // namespace tipp

#endif
