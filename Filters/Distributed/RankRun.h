// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankRun_h
#define tippRankRun_h

#include "Arrays/Concatenated.h"
#include "Distributed/DistributedStatistics.h"
#include "Distributed/Plan.h"
#include "Distributed/PointExchange.h"
#include "Distributed/SharedInitialMesh.h"
#include "Engine/RankEngine.h"
#include "Triangulation/Dataflow.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// A rank's part of a triangulation in the plane.
///
/// Every rank finds the conflicts of some partitions in its part of the initial mesh, and computes
/// the order from all ranks' conflicts. There is no master: the owner of a partition's points keeps
/// its inbox and starts it.
template <typename Id>
class RankRun : public RankEngine<VertexMessage>
{
public:
  RankRun(Communicator& ranks, const Plan& plan, OwnedPoints<Id>& points,
    const DistributedOptions& options, int threads)
    : RankEngine(ranks, std::size_t(plan.Leaves.size()), points.size(), options.Progress)
    , InteriorCounts(static_cast<std::size_t>(plan.Leaves.size()), 0)
    , Work(plan)
    , Options(options)
    , Threads(threads)
    , Points(points)
    , FirstId(points.FirstIds[std::size_t(ranks.rank())])
  {
  }

  /// Runs the triangulation. Collective. Throws RankFailure.
  void run()
  {
    this->makeInitialMesh();
    if (!this->PartitionsPay)
    {
      return;
    }
    std::vector<Contribution> parts(std::size_t(this->Threads));
    const double seconds =
      this->runThreads(parts, [this](Contribution& part) { this->work(part); });
    for (Contribution& part : parts)
    {
      this->Boundary.append(std::move(part.Boundary));
      this->Duplicates.insert(
        this->Duplicates.end(), part.Duplicates.begin(), part.Duplicates.end());
      this->Statistics.WorkerVertices += part.WorkerVertices;
      this->Statistics.ComputeSeconds += part.Seconds;
      this->Statistics.Partitions += part.Partitions;
    }
    this->Statistics.WaitSeconds =
      std::max(0.0, seconds - this->Statistics.ComputeSeconds / this->Threads);
    this->gatherFigures();
    // The first rank has the triangles at the hull (Lemma 3).
    std::vector<BoundaryVertex> vertices = gatherList(this->Ranks, this->Boundary.HullVertices);
    if (this->Ranks.isFirst())
    {
      repairHull(std::move(vertices), this->Artificial, this->Boundary);
    }
    for (const auto& triangle : this->Boundary.Triangles)
    {
      this->Kept.push_back(triangle.Ids);
    }
  }

  /// Boundary triangles that have become final on this rank, by internal ids.
  std::vector<IdTriangle> Kept;
  std::vector<std::size_t> InteriorCounts; ///< number of interior triangles, by partition
  std::vector<Duplicate> Duplicates;       ///< with internal ids
  RankStatistics Statistics;
  bool PartitionsPay = true; ///< the same on all ranks; false: nothing was done

protected:
  /// Returns by partition the rank that keeps its inbox.
  virtual const std::vector<std::int32_t>& keepers() const { return this->Work.Owners; }

  /// Makes the queue from which threads take partitions. Called once the order is known.
  virtual void makeQueue()
  {
    this->Ready = std::make_unique<ReadyPartitions>(
      *this->OwnOrder, ReadyPartitions::Waits::ForEarlier, this->chosenBy(this->Work.Owners));
  }

  /// Called by the thread that has triangulated a partition.
  virtual void addSeconds(PartitionIndex /*p*/, double /*seconds*/) {}

  /// Called when all partitions are done. Collective.
  virtual void gatherFigures() {}

  std::int32_t ownerOf(PartitionIndex p) const override
  {
    return this->Work.Owners[std::size_t(p)];
  }
  ReadyPartitions& source() override { return *this->Ready; }

  /// Returns for each partition whether `ranks` assigns it to this rank and it has points.
  std::vector<char> chosenBy(const std::vector<std::int32_t>& ranks) const
  {
    std::vector<char> isChosen(ranks.size(), 0);
    for (std::size_t p = 0; p < isChosen.size(); ++p)
    {
      isChosen[p] = ranks[p] == this->Ranks.rank() && this->Boxes->areUsed()[p];
    }
    return isChosen;
  }

  const Plan& Work;
  const DistributedOptions& Options;
  const int Threads;
  std::unique_ptr<PartitionOrder> OwnOrder;
  std::unique_ptr<ReadyPartitions> Ready; ///< partitions whose inboxes this rank keeps

private:
  /// A partition's region, as ranks send it to each other.
  struct RegionEntry
  {
    Box2 Box;
    PartitionIndex Partition;
  };

  /// A thread's part of the result.
  struct Contribution
  {
    FinalBoundary<std::int64_t> Boundary;
    std::vector<Duplicate> Duplicates;
    std::int64_t WorkerVertices = 0;
    std::int64_t Partitions = 0;
    double Seconds = 0; ///< computing time
  };

  void makeInitialMesh()
  {
    const std::vector<BoundaryVertex> vertices = this->shareInitialPoints();
    this->Artificial = makeArtificialPoints(this->Work.Leaves);
    keepOneOfEachPosition(this->Artificial);
    if (this->Artificial.empty())
    {
      this->PartitionsPay = false;
      return;
    }
    const InitialMeshPart part(
      *this->Boxes, vertices, this->Artificial, this->chosenBy(this->keepers()), this->Threads);
    std::vector<std::int64_t> counts(2, 0);
    part.countMet(counts[0], counts[1]);
    this->Ranks.sum(counts);
    const bool chosen = this->Options.Minor.isGiven() || this->Options.Major.isGiven();
    this->PartitionsPay = chosen || partitionsPay(counts[0], counts[1]);
    if (!this->PartitionsPay)
    {
      return;
    }
    this->OwnOrder = std::make_unique<PartitionOrder>(this->Boxes->areUsed(),
      joinConflicts(this->Ranks.allGather(part.conflicts()), this->keepers().size()));
    this->makeQueue();
    this->begin(*this->OwnOrder, this->OwnOrder->sequence());
    // The triangles of this rank's part go to the inboxes that it keeps.
    for (auto& [to, message] : sendInitialMesh(part.Mesh, *this->Order))
    {
      if (this->keeperOf(to) == this->Ranks.rank())
      {
        this->put(to, std::move(message));
      }
    }
  }

  /// Gathers the regions and initial points of all partitions on all ranks. Those of a partition
  /// come from its owner.
  std::vector<BoundaryVertex> shareInitialPoints()
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

  /// A worker thread's loop.
  void work(Contribution& part)
  {
    Worker<Id> worker(this->Work.Leaves, this->Points.Buckets, this->FirstId);
    Routing<Id> routing(*this->Order, *this->Boxes);
    for (PartitionIndex p = this->take(); p != NoPartition; p = this->take())
    {
      const ProcessorWatch watch;
      routing.triangulate(worker, p, this->Inboxes[std::size_t(p)].take());
      SentMessages sent = routing.send(worker, part.Boundary);
      this->InteriorCounts[std::size_t(p)] = worker.interiorCount();
      part.WorkerVertices += std::int64_t(worker.vertexCount());
      part.Duplicates.insert(
        part.Duplicates.end(), worker.duplicates().begin(), worker.duplicates().end());
      ++part.Partitions;
      const double seconds = watch.seconds();
      part.Seconds += seconds;
      this->addSeconds(p, seconds);
      this->finish(p, std::move(sent), this->Points.Buckets.count(p));
    }
  }

  OwnedPoints<Id>& Points;
  const std::int64_t FirstId;
  std::vector<BoundaryVertex> Artificial;
  std::unique_ptr<Regions> Boxes;
  FinalBoundary<std::int64_t> Boundary;
};

} // namespace tipp

#endif
