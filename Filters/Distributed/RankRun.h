// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankRun_h
#define tippRankRun_h

#include "Distributed/DistributedTriangulation.h"
#include "Distributed/Plan.h"
#include "Distributed/PointExchange.h"
#include "Distributed/RankEngine.h"
#include "Distributed/SharedInitialMesh.h"
#include "Parallel/Sort.h"
#include "Triangulation/Dataflow.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{

/// A rank's part of a triangulation in the plane.
///
/// Every rank finds the conflicts of some partitions in its part of the initial mesh, and computes
/// the order from all ranks' conflicts. With the dissertation's masters, the keeper of a partition
/// is the first rank (Algorithm 1), or the lead of its major partition's group (Algorithm 3).
template <typename Id>
class RankRun : public RankEngine<VertexMessage>
{
public:
  RankRun(Communicator& ranks, const Plan& plan, OwnedPoints<Id>& points,
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
      this->Statistics.ComputeSeconds +=
        std::accumulate(part.Seconds.begin(), part.Seconds.end(), 0.0);
    }
    this->Statistics.WaitSeconds =
      std::max(0.0, seconds - this->Statistics.ComputeSeconds / this->Threads);
    if (this->hasMasters())
    {
      this->keepFigures(parts);
    }
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
  std::vector<MasterStatistics> Masters;   ///< statistics of the masters on this rank
  bool PartitionsPay = true;               ///< the same on all ranks; false: nothing was done

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
    std::vector<double> Seconds; ///< computing time, by colour
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
    this->Keepers = this->Options.isMasterless() ? this->Work.Owners : this->Work.masters();
    const InitialMeshPart part(
      *this->Boxes, vertices, this->Artificial, this->thoseOf(this->Keepers), this->Threads);
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
      joinConflicts(this->Ranks.allGather(part.conflicts()), this->Keepers.size()));
    this->decideWhoWaits();
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

  void decideWhoWaits()
  {
    using Waits = ReadyPartitions::Waits;
    this->DistinctKeepers = this->Keepers;
    sortUnique(this->DistinctKeepers);
    this->InFlight.assign(std::size_t(this->Ranks.size()), 0);
    this->Ready = std::make_unique<ReadyPartitions>(*this->OwnOrder,
      this->hasBarriers() ? Waits::ForColour : Waits::ForEarlier, this->thoseOf(this->Keepers));
    if (!this->Options.isMasterless())
    {
      this->Started = std::make_unique<ReadyPartitions>(
        *this->OwnOrder, Waits::ForLoad, this->thoseOf(this->Work.Owners));
    }
    this->begin(*this->OwnOrder, this->OwnOrder->sequence());
  }

  std::int32_t ownerOf(PartitionIndex p) const override
  {
    return this->Work.Owners[std::size_t(p)];
  }
  std::int32_t keeperOf(PartitionIndex p) const override { return this->Keepers[std::size_t(p)]; }

  /// For each partition, whether `ranks` assigns it to this rank and it has points.
  std::vector<char> thoseOf(const std::vector<std::int32_t>& ranks) const
  {
    std::vector<char> those(ranks.size(), 0);
    for (std::size_t p = 0; p < those.size(); ++p)
    {
      those[p] = ranks[p] == this->Ranks.rank() && this->Boxes->areUsed()[p];
    }
    return those;
  }

  std::vector<std::int32_t> recipientsOf(PartitionIndex p) const override
  {
    std::vector<std::int32_t> ranks = RankEngine::recipientsOf(p);
    if (this->hasMasters())
    {
      ranks.push_back(this->keeperOf(p));
    }
    if (this->hasBarriers())
    {
      ranks.insert(ranks.end(), this->DistinctKeepers.begin(), this->DistinctKeepers.end());
    }
    sortUnique(ranks);
    return ranks;
  }

  ReadyPartitions& source() override { return this->hasMasters() ? *this->Started : *this->Ready; }

  /// A worker thread's loop.
  void work(Contribution& part)
  {
    Worker<Id> worker(this->Work.Leaves, this->Points.Buckets, this->FirstId);
    Routing<Id> routing(*this->Order, *this->Boxes);
    part.Seconds.assign(this->Order->colourCount(), 0);
    for (PartitionIndex p = this->take(); p >= 0; p = this->take())
    {
      const ProcessorWatch watch;
      routing.triangulate(worker, p, this->Inboxes[std::size_t(p)].take());
      SentMessages sent = routing.send(worker, part.Boundary);
      this->InteriorCounts[std::size_t(p)] = worker.interiorCount();
      part.WorkerVertices += std::int64_t(worker.vertexCount());
      part.Duplicates.insert(
        part.Duplicates.end(), worker.duplicates().begin(), worker.duplicates().end());
      part.Seconds[this->Order->colourOf(p)] += watch.seconds();
      this->finish(p, std::move(sent), this->Points.Buckets.count(p));
    }
  }

  void put(PartitionIndex to, VertexMessage&& message) override
  {
    this->KeptTriangles += message.Cells;
    RankEngine::put(to, std::move(message));
  }

  void setDone(PartitionIndex p) override
  {
    this->Ready->finish(p);
    if (this->hasMasters() && this->keeperOf(p) == this->Ranks.rank())
    {
      --this->InFlight[std::size_t(this->ownerOf(p))];
      --this->AllInFlight;
    }
  }

  void setDoneHere(PartitionIndex p) override
  {
    if (!this->hasMasters())
    {
      this->Ready->finish(p);
      return;
    }
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->DoneHere.push_back(p);
  }

  void receive(const Message& message) override
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

  /// Sums the statistics of several masters stage by stage.
  static void addStages(const std::vector<TriangulationStatistics::Stage>& more,
    std::vector<TriangulationStatistics::Stage>& stages)
  {
    stages.resize(std::max(stages.size(), more.size()));
    for (std::size_t i = 0; i < more.size(); ++i)
    {
      stages[i].ActivePartitions += more[i].ActivePartitions;
      stages[i].MeshTriangles += more[i].MeshTriangles;
    }
  }

  /// Collects the statistics. Collective.
  void keepFigures(const std::vector<Contribution>& parts)
  {
    std::vector<double> seconds(this->Order->colourCount(), 0);
    for (const Contribution& part : parts)
    {
      std::transform(part.Seconds.begin(), part.Seconds.end(), seconds.begin(), seconds.begin(),
        std::plus<double>());
    }
    if (!this->hasBarriers())
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
    sortUnique(group);
    this->Figures.Rank = rank;
    this->Figures.GroupSize = std::int32_t(group.size());
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

  /// @name Functions of a master
  ///@{
  bool hasMasters() const { return this->Started != nullptr; }
  bool hasBarriers() const { return this->Options.Order != RankSchedule::Dynamic; }

  /// Marks this rank's partitions as done, and starts all partitions that may start. Returns false
  /// if there are none.
  bool startPartitions() override
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

  bool areOthersWaiting() const override { return this->hasMasters(); }

  /// Whether a partition may start now. With barriers, a rank gets at most one partition per
  /// thread; in waves (Algorithm 1), all started partitions must be done first.
  bool canStart(PartitionIndex p) const
  {
    return !this->hasBarriers() || this->InFlight[std::size_t(this->ownerOf(p))] < this->Threads;
  }

  void start(PartitionIndex p)
  {
    const std::vector<VertexMessage> messages = this->Inboxes[std::size_t(p)].take();
    VertexMessage all{ -1, cellsOf(messages), UniqueVertices().collect(messages) };
    const std::int32_t owner = this->ownerOf(p);
    ++this->InFlight[std::size_t(owner)];
    ++this->AllInFlight;
    const std::int64_t kept = this->KeptTriangles;
    this->Figures.LargestMesh = std::max(this->Figures.LargestMesh, kept);
    const std::size_t colour = this->Order->colourOf(p);
    if (!this->hasBarriers())
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
  void receiveTask(const Message& message)
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

  ///@}

  const Plan& Work;
  OwnedPoints<Id>& Points;
  const DistributedOptions& Options;
  const int Threads;
  const std::int64_t FirstId;
  std::vector<BoundaryVertex> Artificial;
  std::unique_ptr<Regions> Boxes;
  std::unique_ptr<PartitionOrder> OwnOrder;
  std::vector<std::int32_t> Keepers;         ///< by partition: the rank that keeps its inbox
  std::vector<std::int32_t> DistinctKeepers; ///< the different ranks in Keepers
  std::unique_ptr<ReadyPartitions> Ready;    ///< partitions that this rank keeps
  std::unique_ptr<ReadyPartitions> Started;  ///< partitions that it owns; null: same as Ready
  FinalBoundary<std::int64_t> Boundary;

  // Used by masters only.
  std::vector<PartitionIndex> DoneHere; ///< for the main thread; protected by Mutex
  std::vector<PartitionIndex> Waiting;  ///< ready, but their ranks are busy
  std::vector<int> InFlight;            ///< by rank: number of partitions started and not done
  int AllInFlight = 0;
  std::atomic<std::int64_t> KeptTriangles{ 0 }; ///< triangles in the inboxes
  MasterStatistics Figures;
};

} // namespace tipp

#endif
