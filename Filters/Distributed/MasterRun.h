// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMasterRun_h
#define tippMasterRun_h

#include "Distributed/RankRun.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{

/// A rank's part of a triangulation in the plane with the dissertation's masters, which keep the
/// inboxes of partitions: the first rank keeps all (Algorithm 1), or the lead of a major
/// partition's group keeps those of this major partition (Algorithm 3). To start a partition, its
/// master sends its inbox to the rank that owns its points.
template <typename Id>
class MasterRun : public RankRun<Id>
{
public:
  MasterRun(Communicator& ranks, const Plan& plan, OwnedPoints<Id>& points,
    const DistributedOptions& options, int threads)
    : RankRun<Id>(ranks, plan, points, options, threads)
    , Keepers(plan.masters())
  {
  }

  std::vector<MasterStatistics> Masters; ///< statistics of the masters on this rank

private:
  bool hasBarriers() const { return this->Options.Order != RankSchedule::Dynamic; }

  const std::vector<std::int32_t>& keepers() const override { return this->Keepers; }
  std::int32_t keeperOf(PartitionIndex p) const override { return this->Keepers[std::size_t(p)]; }

  void makeQueue() override
  {
    using Waits = ReadyPartitions::Waits;
    const PartitionOrder& order = *this->OwnOrder;
    this->DistinctKeepers = this->Keepers;
    sortUnique(this->DistinctKeepers);
    this->InFlight.assign(std::size_t(this->Ranks.size()), 0);
    this->Seconds.assign(order.colourCount(), 0);
    this->Ready = std::make_unique<ReadyPartitions>(order,
      this->hasBarriers() ? Waits::ForColour : Waits::ForEarlier, this->chosenBy(this->Keepers));
    this->Started =
      std::make_unique<ReadyPartitions>(order, Waits::ForLoad, this->chosenBy(this->Work.Owners));
    const int rank = this->Ranks.rank();
    this->AwaitedTasks = std::size_t(std::count_if(order.sequence().begin(), order.sequence().end(),
      [&](PartitionIndex p) { return this->ownerOf(p) == rank && this->keeperOf(p) != rank; }));
  }

  ReadyPartitions& source() override { return *this->Started; }
  bool areOthersWaiting() const override { return true; }
  bool isFinished() const override { return this->AwaitedTasks == 0 && RankRun<Id>::isFinished(); }

  std::vector<std::int32_t> recipientsOf(PartitionIndex p) const override
  {
    std::vector<std::int32_t> ranks = RankRun<Id>::recipientsOf(p);
    ranks.push_back(this->keeperOf(p));
    if (this->hasBarriers())
    {
      ranks.insert(ranks.end(), this->DistinctKeepers.begin(), this->DistinctKeepers.end());
    }
    sortUnique(ranks);
    return ranks;
  }

  void put(PartitionIndex to, VertexMessage&& message) override
  {
    this->KeptTriangles += message.Cells;
    RankRun<Id>::put(to, std::move(message));
  }

  void setDone(PartitionIndex p) override
  {
    this->Ready->finish(p);
    if (this->keeperOf(p) == this->Ranks.rank())
    {
      --this->InFlight[std::size_t(this->ownerOf(p))];
      --this->AllInFlight;
    }
  }

  void setDoneHere(PartitionIndex p) override
  {
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
    RankRun<Id>::receive(message);
    this->Figures.Seconds += watch.seconds();
  }

  /// Marks this rank's partitions as done, and starts all partitions that may start. Returns false
  /// if there are none.
  bool startPartitions() override
  {
    std::vector<PartitionIndex> done;
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      done.swap(this->DoneHere);
    }
    std::for_each(done.begin(), done.end(), [this](PartitionIndex p) { this->setDone(p); });
    const ProcessorWatch watch;
    for (PartitionIndex p = this->Ready->tryTake(); p != NoPartition; p = this->Ready->tryTake())
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

  /// Whether a partition may start now. With barriers, a rank gets at most one partition per
  /// thread; in waves (Algorithm 1), all started partitions must be done first.
  bool canStart(PartitionIndex p) const
  {
    return !this->hasBarriers() || this->InFlight[std::size_t(this->ownerOf(p))] < this->Threads;
  }

  void start(PartitionIndex p)
  {
    const std::vector<VertexMessage> messages = this->Inboxes[std::size_t(p)].take();
    VertexMessage all{ NoPartition, cellsOf(messages), UniqueVertices().collect(messages) };
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

  void addSeconds(PartitionIndex p, double seconds) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Seconds[this->Order->colourOf(p)] += seconds;
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
  void gatherFigures() override
  {
    std::vector<double> seconds = std::move(this->Seconds);
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

  const std::vector<std::int32_t> Keepers;   ///< by partition: the rank that keeps its inbox
  std::vector<std::int32_t> DistinctKeepers; ///< the different ranks in Keepers
  std::unique_ptr<ReadyPartitions> Started;  ///< partitions that this rank owns
  std::size_t AwaitedTasks = 0;              ///< partitions that other ranks will start here
  std::vector<PartitionIndex> DoneHere;      ///< for the main thread; protected by Mutex
  std::vector<PartitionIndex> Waiting;       ///< ready, but their ranks are busy
  std::vector<int> InFlight;                 ///< by rank: number of partitions started and not done
  int AllInFlight = 0;
  std::atomic<std::int64_t> KeptTriangles{ 0 }; ///< triangles in the inboxes
  std::vector<double> Seconds;                  ///< computing time by colour; protected by Mutex
  MasterStatistics Figures;
};

} // namespace tipp

#endif
