// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Triangulate.h"

#include "Engine/PartitionSchedule.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/InitialMesh.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <mutex>

namespace tipp
{
namespace
{

Buffer<std::int32_t>& idsOf(Triangulation& result, std::int32_t)
{
  return result.Ids32;
}
Buffer<std::int64_t>& idsOf(Triangulation& result, std::int64_t)
{
  return result.Ids64;
}

/// For a short pass, waking threads costs more than they save.
int threadsForPass(std::size_t points, int threads)
{
  constexpr std::size_t shortest = 32768;
  return static_cast<int>(std::min(static_cast<std::size_t>(threads), 1 + points / shortest));
}

/// One run of the algorithm; its member functions are the steps.
template <typename Id>
class PartitionedTriangulation
{
public:
  PartitionedTriangulation(
    PointsView points, const TriangulationOptions& options, Triangulation& result)
    : Points(points)
    , Options(options)
    , Result(result)
    , Threads(result.Statistics.Threads)
    , PassThreads(threadsForPass(points.size(), result.Statistics.Threads))
  {
  }

  void run(const Tiling& tiling)
  {
    this->Result.Statistics.Partitions = tiling.size();
    const std::vector<BoundaryVertex> artificial = makeArtificialPoints(tiling);
    if (tiling.size() == 1 || artificial.empty())
    {
      this->triangulateAlone(tiling);
      return;
    }
    this->Buckets = bucketPoints<Id>(this->Points, tiling, this->PassThreads);
    this->checkSizes();
    this->endPhase("bucketing");
    if (!this->hasGrid() && this->onePartitionHasMost())
    {
      this->triangulateAlone(tiling);
      return;
    }
    const Regions regions(tiling, this->Buckets, this->PassThreads);
    BoundaryTriangles initialMesh =
      this->makeInitialMesh(tiling, regions, artificial, this->initialPointsPerPartition());
    const auto pays = [&]
    { return this->hasGrid() || partitionsPay(initialMesh, MostMetPartitions); };
    if (!pays() && this->Options.InitialPointsPerPartition == 0)
    {
      // With more points the circumdisks shrink, but not those of points on a curve.
      initialMesh =
        this->makeInitialMesh(tiling, regions, artificial, 4 * InitialPointsOfPartition);
    }
    if (!pays())
    {
      this->triangulateAlone(tiling);
      return;
    }
    this->work(tiling, regions, initialMesh, artificial);
  }

private:
  void checkSizes() const
  {
    for (PartitionIndex p = 0; p < this->Buckets.partitions(); ++p)
    {
      requireFitsKernel(this->Buckets.count(p));
    }
  }

  bool hasGrid() const { return this->Options.Columns > 0 && this->Options.Rows > 0; }

  int initialPointsPerPartition() const
  {
    return this->Options.InitialPointsPerPartition > 0 ? this->Options.InitialPointsPerPartition
                                                       : InitialPointsOfPartition;
  }

  /// Whether one partition has more than 7/8 of the points. Several threads would then gain less
  /// than a seventh (Amdahl 1967).
  bool onePartitionHasMost() const
  {
    std::int64_t most = 0;
    for (PartitionIndex p = 0; p < this->Buckets.partitions(); ++p)
    {
      most = std::max(most, std::int64_t(this->Buckets.count(p)));
    }
    return most > std::int64_t(this->Buckets.size()) / 8 * 7;
  }

  BoundaryTriangles makeInitialMesh(const Tiling& tiling, const Regions& regions,
    const std::vector<BoundaryVertex>& artificial, int pointsPerPartition)
  {
    std::vector<BoundaryVertex> initial =
      chooseInitialPoints(tiling, this->Buckets, pointsPerPartition, this->PassThreads);
    this->Result.Statistics.InitialPoints = std::int64_t(initial.size());
    initial.insert(initial.end(), artificial.begin(), artificial.end());
    return triangulateVertices<2>(regions, initial, this->PassThreads);
  }

  void endPhase(const char* name)
  {
    this->Result.Statistics.Phases.push_back({ name, this->Watch.restart() });
  }

  bool report(double fraction)
  {
    return !this->Options.Progress || this->Options.Progress(fraction);
  }

  /// Triangulates all points at once, without partitions and artificial points.
  void triangulateAlone(const Tiling& tiling)
  {
    this->Buckets = {}; // frees the partitions' buckets before the new ones are made
    this->Buckets = bucketTogether<Id>(
      this->Points, tiling.domain(), this->Result.Rejected.empty(), this->PassThreads);
    this->checkSizes();
    this->endPhase("bucketing");
    this->Result.Statistics.Partitions = 1;
    TriangleSink<Id> sink(this->Buckets);
    Worker<Id> worker(tiling, this->Buckets);
    this->beginEditing(Tiling::grid(tiling.domain(), 1, 1));
    this->setEditor(worker);
    const double all = double(this->Buckets.size());
    this->Result.Aborted = !worker.triangulateAlone(
      [this, all](std::size_t inserted) { return this->report(double(inserted) / all); });
    if (this->Result.Aborted)
    {
      return;
    }
    sink.setInteriorCount(0, worker.interiorCount());
    this->Result.Duplicates = worker.duplicates();
    this->Result.Statistics.WorkerVertices = std::int64_t(worker.vertexCount());
    this->endPhase("workers");
    this->finish(sink, {});
  }

  /// The data that the threads of a run share.
  struct Shared
  {
    const Tiling& Tiles;
    const Regions& Boxes;
    const PartitionOrder& Order;
    std::vector<Inbox> Inboxes;
    ReadyPartitions Ready;
    std::vector<TriangulationStatistics::Stage>
      Stages; ///< one per started partition, or per colour
    std::atomic<std::int64_t> Active{ 0 };
    std::atomic<std::int64_t> Unfinished{ 0 }; ///< triangles in inboxes and workers

    void deliver(SentMessages&& sent)
    {
      for (auto& [to, message] : sent)
      {
        this->Unfinished += message.Cells;
        this->Inboxes[std::size_t(to)].put(std::move(message));
      }
    }
  };

  /// A thread's part of the result.
  struct Contribution
  {
    FinalBoundary<Id> Boundary;
    std::vector<Duplicate> Duplicates;
    std::size_t WorkerVertices = 0;
  };

  void work(const Tiling& tiling, const Regions& regions, const BoundaryTriangles& initialMesh,
    const std::vector<BoundaryVertex>& artificial)
  {
    const PartitionOrder order(regions.areUsed(), initialMesh);
    const bool barrier = this->Options.Order == Schedule::Stages;
    Shared shared{ tiling, regions, order, std::vector<Inbox>(order.partitionCount()),
      ReadyPartitions(
        order, barrier ? ReadyPartitions::Waits::ForColour : ReadyPartitions::Waits::ForEarlier),
      {} };
    shared.Stages.resize(order.sequence().size());
    shared.deliver(sendInitialMesh(initialMesh, order));
    this->endPhase("initial mesh");
    this->beginEditing(tiling);
    TriangleSink<Id> sink(this->Buckets);
    std::vector<Contribution> parts(std::size_t(this->Threads));
    runWorkers(shared.Ready, this->Threads,
      [&](int thread) { this->workAsOneThread(shared, sink, parts[std::size_t(thread)]); });
    this->endPhase("workers");
    FinalBoundary<Id> boundary;
    TriangulationStatistics& statistics = this->Result.Statistics;
    statistics.Stages = stagesOf(shared.Stages, order, barrier);
    this->Result.Aborted = shared.Ready.isStopped();
    std::vector<std::vector<typename TriangleSink<Id>::FinalTriangle>> triangles;
    for (Contribution& part : parts)
    {
      boundary.HullVertices.insert(boundary.HullVertices.end(), part.Boundary.HullVertices.begin(),
        part.Boundary.HullVertices.end());
      triangles.push_back(std::move(part.Boundary.Triangles));
      statistics.WorkerVertices += std::int64_t(part.WorkerVertices);
      this->Result.Duplicates.insert(
        this->Result.Duplicates.end(), part.Duplicates.begin(), part.Duplicates.end());
    }
    if (!this->Result.Aborted)
    {
      repairHull(std::move(boundary.HullVertices), artificial, boundary);
      triangles.push_back(std::move(boundary.Triangles));
      this->endPhase("hull");
      this->finish(sink, triangles);
    }
  }

  void beginEditing(const Tiling& tiling) const
  {
    if (this->Options.Editors)
    {
      this->Options.Editors->begin(this->Points, tiling);
    }
  }

  void setEditor(Worker<Id>& worker) const
  {
    if (this->Options.Editors)
    {
      worker.setEditor(this->Options.Editors->makeEditor());
    }
  }

  /// What a thread needs to triangulate a partition.
  struct Lane
  {
    Lane(const PartitionedTriangulation& run, Shared& shared, PointBuckets<Id>& buckets)
      : Triangles(shared.Tiles, buckets)
      , Messages(shared.Order, shared.Boxes)
    {
      run.setEditor(this->Triangles);
    }

    Worker<Id> Triangles;
    Routing<Id> Messages;
    PartitionIndex Partition = NoPartition;
    std::int64_t Handed = 0; ///< triangles whose vertices were in the inbox
  };

  /// Triangulates two partitions at a time, as long as enough are left for all threads.
  void workAsOneThread(Shared& shared, TriangleSink<Id>& sink, Contribution& part)
  {
    Lane lane(*this, shared, this->Buckets);
    std::unique_ptr<Lane> other;
    for (PartitionIndex p = shared.Ready.take(); p != NoPartition; p = shared.Ready.take())
    {
      begin(shared, lane, p);
      const PartitionIndex q =
        shared.Ready.left() < std::size_t(this->Threads) ? NoPartition : shared.Ready.tryTake();
      if (q == NoPartition)
      {
        lane.Triangles.insertPoints();
        this->finish(shared, lane, sink, part);
        continue;
      }
      if (!other)
      {
        other = std::make_unique<Lane>(*this, shared, this->Buckets);
      }
      begin(shared, *other, q);
      Worker<Id>::insertPoints(lane.Triangles, other->Triangles);
      this->finish(shared, lane, sink, part);
      this->finish(shared, *other, sink, part);
    }
  }

  static void begin(Shared& shared, Lane& lane, PartitionIndex p)
  {
    lane.Partition = p;
    shared.Stages[shared.Order.position(p)] = { ++shared.Active, shared.Unfinished };
    lane.Handed = lane.Messages.prepare(lane.Triangles, p, shared.Inboxes[std::size_t(p)].take());
  }

  void finish(Shared& shared, Lane& lane, TriangleSink<Id>& sink, Contribution& part)
  {
    const PartitionIndex p = lane.Partition;
    const Worker<Id>& worker = lane.Triangles;
    lane.Messages.finish(lane.Triangles);
    shared.deliver(lane.Messages.send(worker, part.Boundary));
    shared.Unfinished -= lane.Handed;
    sink.setInteriorCount(p, worker.interiorCount());
    part.WorkerVertices += worker.vertexCount();
    part.Duplicates.insert(
      part.Duplicates.end(), worker.duplicates().begin(), worker.duplicates().end());
    --shared.Active;
    shared.Ready.finish(p);
    if (!this->reportFinished(this->Buckets.count(p)))
    {
      shared.Ready.stop();
    }
  }

  /// Returns one entry per colour if there are barriers between colours, else one per partition.
  static std::vector<TriangulationStatistics::Stage> stagesOf(
    const std::vector<TriangulationStatistics::Stage>& started, const PartitionOrder& order,
    bool barrier)
  {
    if (!barrier)
    {
      return started;
    }
    std::vector<TriangulationStatistics::Stage> stages;
    std::size_t first = 0;
    for (std::size_t colour = 0; colour < order.colourCount(); ++colour)
    {
      const std::size_t size = order.colourSize(colour);
      stages.push_back({ std::int64_t(size), started[first].MeshTriangles });
      first += size;
    }
    return stages;
  }

  /// Reports progress, one thread at a time, so that the fraction increases. Does nothing after the
  /// callback has returned false. Returns false if the run is to stop.
  bool reportFinished(std::size_t points)
  {
    const std::lock_guard<std::mutex> lock(this->ReportMutex);
    this->PointsDone += points;
    this->Stopped =
      this->Stopped || !this->report(double(this->PointsDone) / double(this->Buckets.size()));
    return !this->Stopped;
  }

  void finish(TriangleSink<Id>& sink,
    const std::vector<std::vector<typename TriangleSink<Id>::FinalTriangle>>& boundary)
  {
    Buffer<Id> ids = sink.assemble(boundary, this->PassThreads);
    this->addBlocks(sink, ids.size() / 3);
    preferLowestIds(ids, this->Result.Duplicates, this->PassThreads);
    idsOf(this->Result, Id()) = std::move(ids);
    this->endPhase("output");
    this->report(1);
  }

  /// Adds a block for each partition, whose interior triangles are contiguous in the output.
  void addBlocks(const TriangleSink<Id>& sink, std::size_t triangles)
  {
    for (PartitionIndex p = 0; p < this->Buckets.partitions(); ++p)
    {
      const std::size_t begin = std::min(2 * this->Buckets.start(p), triangles);
      const std::size_t end = std::min(begin + sink.interiorCount(p), triangles);
      if (begin < end)
      {
        this->Result.Blocks.push_back({ p, begin, end });
      }
    }
  }

  PointsView Points;
  const TriangulationOptions& Options;
  Triangulation& Result;
  const int Threads;
  const int PassThreads; ///< threads for passes over all points
  PointBuckets<Id> Buckets;
  std::mutex ReportMutex;
  std::size_t PointsDone = 0;
  bool Stopped = false;
  Stopwatch Watch;
};

/// Chooses partitions of the size for which workers are fastest, but enough of them for all
/// threads.
int choosePartitionCount(std::size_t points, int threads)
{
  constexpr std::size_t alone = 32768;
  constexpr std::size_t smallest = FewestPointsInPartition;
  constexpr std::size_t best = BestPointsInPartition;
  constexpr std::size_t perThread = PartitionsPerThread;
  if (points <= (threads == 1 ? 3 * best : alone))
  {
    return 1;
  }
  const std::size_t count = std::max(
    points / best, std::min(perThread * static_cast<std::size_t>(threads), points / smallest));
  return static_cast<int>(std::min(count, std::size_t(MostPartitions)));
}

Tiling makeTiling(
  PointsView points, const Box2& domain, const TriangulationOptions& options, int threads)
{
  if (options.Columns > 0 && options.Rows > 0)
  {
    return Tiling::grid(domain, options.Columns, options.Rows);
  }
  const int count = choosePartitionCount(points.size(), threads);
  return Tiling::balanced(
    domain, samplePoints(points, SamplesPerPartition * static_cast<std::size_t>(count)), count);
}

Triangulation triangulateAll(PointsView input, const TriangulationOptions& options)
{
  Triangulation result;
  TriangulationStatistics& statistics = result.Statistics;
  statistics.Threads = threadCount(options.Threads);
  Stopwatch watch;
  const int passThreads = threadsForPass(input.size(), statistics.Threads);
  PointSurveyOf<2> survey = surveyPoints(input, passThreads);
  result.Rejected = std::move(survey.Rejected);
  if (areCollinear(input))
  {
    result.Duplicates = sortOutDuplicates(input);
    return result;
  }
  const PointsView points = withModerateMagnitude(input, survey.Bounds);
  if (points.factor() != 1)
  {
    survey = surveyPoints(points, passThreads);
  }
  const Tiling tiling = makeTiling(points, survey.Bounds, options, statistics.Threads);
  statistics.Phases.push_back({ "survey and tiling", watch.seconds() });
  if (points.size() <= std::size_t(std::numeric_limits<std::int32_t>::max()))
  {
    PartitionedTriangulation<std::int32_t>(points, options, result).run(tiling);
  }
  else
  {
    PartitionedTriangulation<std::int64_t>(points, options, result).run(tiling);
  }
  return result;
}

} // namespace

Triangulation triangulate(PointsView input, const TriangulationOptions& options)
{
  Triangulation result = triangulateAll(input, options);
  leaveOutLong(input, options.MaximumEdge, result);
  return result;
}

void leaveOutLong(PointsView points, double longest, Triangulation& mesh)
{
  const auto drop = [&](auto& ids)
  {
    ids.truncate(3 *
      dropLongTriangles(ids.data(), ids.size() / 3, longest,
        [&points](auto id) { return points[std::size_t(id)]; }));
  };
  if (longest > 0)
  {
    drop(mesh.Ids32);
    drop(mesh.Ids64);
    mesh.Blocks.clear();
  }
}

} // namespace tipp
