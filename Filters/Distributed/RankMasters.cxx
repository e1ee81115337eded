// The masters' part of RankRun. A master starts the partitions whose inboxes it keeps.
#include "Distributed/RankRun.h"
#include "Parallel/Stopwatch.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// Sums the statistics of several masters stage by stage.
void addStages(const std::vector<TriangulationStatistics::Stage>& more,
  std::vector<TriangulationStatistics::Stage>& stages)
{
  stages.resize(std::max(stages.size(), more.size()));
  for (std::size_t i = 0; i < more.size(); ++i)
  {
    stages[i].ActivePartitions += more[i].ActivePartitions;
    stages[i].MeshTriangles += more[i].MeshTriangles;
  }
}

} // namespace

/// Whether a partition may start now. With barriers, a rank gets at most one partition per thread;
/// in waves (Algorithm 1), all started partitions must be done first.
template <typename Id>
bool RankRun<Id>::canStart(PartitionIndex p) const
{
  return this->Options.Order == RankSchedule::Dynamic ||
    this->InFlight[std::size_t(this->ownerOf(p))] < this->Threads;
}

/// Starts all partitions that may start. Returns false if there are none.
template <typename Id>
bool RankRun<Id>::startReady()
{
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

template <typename Id>
void RankRun<Id>::start(PartitionIndex p)
{
  std::vector<VertexMessage> messages = this->Inboxes[std::size_t(p)].take();
  VertexMessage all{ { -1, UniqueVertices().collect(messages) }, 0 };
  for (const VertexMessage& message : messages)
  {
    all.Triangles += message.Triangles;
  }
  const std::int32_t owner = this->ownerOf(p);
  ++this->InFlight[std::size_t(owner)];
  ++this->AllInFlight;
  const std::int64_t kept = this->KeptTriangles;
  this->Figures.LargestMesh = std::max(this->Figures.LargestMesh, kept);
  const bool hasBarriers = this->Options.Order != RankSchedule::Dynamic;
  const std::size_t colour = this->Order->colourOf(p);
  if (!hasBarriers)
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
  this->KeptTriangles -= all.Triangles;
  if (owner == this->Ranks.rank())
  {
    this->Inboxes[std::size_t(p)].put(std::move(all));
    this->Started->setLoaded(p);
    return;
  }
  this->Ranks.post(owner, TaskMessage, packed(p, all));
}

/// Receives a partition to triangulate from its keeper.
template <typename Id>
void RankRun<Id>::receiveTask(const Message& message)
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

/// Collects the statistics. Collective.
template <typename Id>
void RankRun<Id>::keepFigures(const std::vector<Contribution>& parts)
{
  std::vector<double> seconds(this->Order->colourCount(), 0);
  for (const Contribution& part : parts)
  {
    std::transform(part.Seconds.begin(), part.Seconds.end(), seconds.begin(), seconds.begin(),
      std::plus<double>());
  }
  if (this->Options.Order == RankSchedule::Dynamic)
  {
    seconds = { std::accumulate(seconds.begin(), seconds.end(), 0.0) };
  }
  SaveArchive writer;
  writer(seconds);
  writer(this->Figures.Stages);
  writer(this->Figures.LargestMesh);
  MasterStatistics whole;
  std::vector<double> longest(seconds.size(), 0);
  for (const Bytes& part : this->Ranks.gather(writer.take()))
  {
    LoadArchive reader(part);
    const std::vector<double> other = reader.get<std::vector<double>>();
    std::transform(other.begin(), other.end(), longest.begin(), longest.begin(),
      [](double a, double b) { return std::max(a, b); });
    addStages(reader.get<std::vector<TriangulationStatistics::Stage>>(), whole.Stages);
    whole.LargestMesh = std::max(whole.LargestMesh, reader.get<std::int64_t>());
  }
  whole.PathSeconds = std::accumulate(longest.begin(), longest.end(), 0.0);
  const bool isSingle = this->Work.Areas.front().hasLeaves();
  const int rank = this->Ranks.rank();
  std::vector<std::int32_t> group;
  for (const PartitionIndex p : this->Order->sequence())
  {
    if (this->keeperOf(p) == rank)
    {
      group.push_back(this->ownerOf(p));
    }
  }
  std::sort(group.begin(), group.end());
  this->Figures.Rank = rank;
  this->Figures.GroupSize = std::int32_t(std::unique(group.begin(), group.end()) - group.begin());
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

template bool RankRun<std::int32_t>::startReady();
template bool RankRun<std::int32_t>::canStart(PartitionIndex) const;
template void RankRun<std::int32_t>::start(PartitionIndex);
template void RankRun<std::int32_t>::receiveTask(const Message&);
template void RankRun<std::int32_t>::keepFigures(const std::vector<Contribution>&);
template bool RankRun<std::int64_t>::startReady();
template bool RankRun<std::int64_t>::canStart(PartitionIndex) const;
template void RankRun<std::int64_t>::start(PartitionIndex);
template void RankRun<std::int64_t>::receiveTask(const Message&);
template void RankRun<std::int64_t>::keepFigures(const std::vector<Contribution>&);

} // namespace tipp
