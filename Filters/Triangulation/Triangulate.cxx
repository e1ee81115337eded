// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Triangulate.h"

#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/DegenerateInput.h"
#include "Triangulation/InitialMesh.h"
#include "Triangulation/Master.h"
#include "Triangulation/PartitionSizes.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/TriangleSink.h"
#include "Triangulation/Worker.h"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

namespace tipp
{
namespace
{

template <typename Id>
Buffer<Id>& idsOf(Triangulation& result);
template <>
Buffer<std::int32_t>& idsOf(Triangulation& result)
{
  return result.Ids32;
}
template <>
Buffer<std::int64_t>& idsOf(Triangulation& result)
{
  return result.Ids64;
}

/// Waking a thread costs more than a short pass.
int threadsForPass(std::size_t points, int threads)
{
  constexpr std::size_t shortest = 32768;
  return static_cast<int>(std::min(static_cast<std::size_t>(threads), 1 + points / shortest));
}

/// One run of the algorithm, step by step.
template <typename Id>
class Run
{
public:
  Run(PointsView points, const TriangulationOptions& options, Triangulation& result)
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
    const std::vector<SeamVertex> artificial = makeArtificialPoints(tiling);
    if (tiling.size() == 1 || artificial.empty())
    {
      this->triangulateAlone(tiling);
      return;
    }
    this->Buckets = bucketPoints<Id>(this->Points, tiling, this->PassThreads);
    this->checkSizes();
    this->endPhase("bucketing");
    std::vector<SeamVertex> initial =
      chooseInitialPoints(tiling, this->Buckets, initialPointsPerPartition());
    this->Result.Statistics.InitialPoints = std::int64_t(initial.size());
    initial.insert(initial.end(), artificial.begin(), artificial.end());
    const SeamTriangles initialMesh = triangulateVertices(tiling, initial, this->PassThreads);
    if (!this->hasGrid() && !partitionsPay(initialMesh))
    {
      this->triangulateAlone(tiling);
      return;
    }
    Master master(
      this->Options.Order, tiling.size(), this->partitionsWithPoints(tiling), initialMesh);
    this->endPhase("initial mesh");
    this->work(tiling, master, artificial);
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

  std::vector<PartitionIndex> partitionsWithPoints(const Tiling& tiling) const
  {
    std::vector<PartitionIndex> partitions;
    for (PartitionIndex p = 0; p < tiling.size(); ++p)
    {
      if (this->Buckets.count(p) > 0)
      {
        partitions.push_back(p);
      }
    }
    return partitions;
  }

  void endPhase(const char* name)
  {
    this->Result.Statistics.Phases.push_back({ name, this->Watch.restart() });
  }

  bool report(double fraction)
  {
    return !this->Options.Progress || this->Options.Progress(fraction);
  }

  /// All points at once: no partitions, no artificial points.
  void triangulateAlone(const Tiling& tiling)
  {
    this->Buckets = bucketTogether<Id>(
      this->Points, tiling.domain(), this->Result.Rejected.empty(), this->PassThreads);
    this->checkSizes();
    this->endPhase("bucketing");
    this->Result.Statistics.Partitions = 1;
    TriangleSink<Id> sink(this->Buckets);
    Worker<Id> worker(tiling, this->Buckets);
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

  void work(const Tiling& tiling, Master& master, const std::vector<SeamVertex>& artificial)
  {
    TriangleSink<Id> sink(this->Buckets);
#pragma omp parallel num_threads(this->Threads)
    {
      try
      {
        this->workAsOneThread(tiling, master, sink);
      }
      catch (...)
      {
        master.stop(std::current_exception());
      }
    }
    if (master.failure())
    {
      std::rethrow_exception(master.failure());
    }
    TriangulationStatistics& statistics = this->Result.Statistics;
    this->endPhase("workers");
    statistics.Phases.push_back({ "master, within workers", master.Seconds });
    statistics.Stages = std::move(master.Stages);
    statistics.WorkerVertices = std::int64_t(master.WorkerVertices);
    this->Result.Aborted = master.isStopped();
    if (this->Result.Aborted)
    {
      return;
    }
    master.Final.removeArtificialPoints(artificial);
    this->endPhase("hull");
    this->Result.Duplicates = std::move(master.Duplicates);
    this->finish(sink, master.Final);
  }

  void workAsOneThread(const Tiling& tiling, Master& master, TriangleSink<Id>& sink)
  {
    Worker<Id> worker(tiling, this->Buckets);
    std::vector<SeamTriangle> belonging;
    for (;;)
    {
      const PartitionIndex partition = master.acquire(belonging);
      if (partition < 0)
      {
        return;
      }
      worker.triangulate(partition, belonging);
      sink.setInteriorCount(partition, worker.interiorCount());
      master.complete(partition, worker.seams(), worker.duplicates(), worker.vertexCount());
      if (!this->reportFinished(this->Buckets.count(partition)))
      {
        master.stop();
      }
    }
  }

  /// Threads report one at a time, so that the fraction rises; none after one was told to stop.
  bool reportFinished(std::size_t points)
  {
    const std::lock_guard<std::mutex> lock(this->ReportMutex);
    this->PointsDone += points;
    this->Stopped =
      this->Stopped || !this->report(double(this->PointsDone) / double(this->Buckets.size()));
    return !this->Stopped;
  }

  void finish(TriangleSink<Id>& sink, const FinalSeams& seams)
  {
    Buffer<Id> ids = sink.assemble(seams, this->PassThreads);
    preferLowestIds(ids, this->Result.Duplicates, this->PassThreads);
    idsOf<Id>(this->Result) = std::move(ids);
    this->endPhase("output");
    this->report(1);
  }

  PointsView Points;
  const TriangulationOptions& Options;
  Triangulation& Result;
  const int Threads;
  const int PassThreads; ///< for passes over all points
  PointBuckets<Id> Buckets;
  std::mutex ReportMutex;
  std::size_t PointsDone = 0;
  bool Stopped = false;
  Stopwatch Watch;
};

/// Partitions of the size that workers are fastest at, but enough of them for all threads.
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

} // namespace

Triangulation triangulate(PointsView input, const TriangulationOptions& options)
{
  Triangulation result;
  TriangulationStatistics& statistics = result.Statistics;
  statistics.Threads = threadCount(options.Threads);
  Stopwatch watch;
  const int passThreads = threadsForPass(input.size(), statistics.Threads);
  PointSurvey survey = surveyPoints(input, passThreads);
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
    Run<std::int32_t>(points, options, result).run(tiling);
  }
  else
  {
    Run<std::int64_t>(points, options, result).run(tiling);
  }
  return result;
}

} // namespace tipp
