// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/DistributedTriangulation.h"

#include "Distributed/MasterRun.h"
#include "Distributed/NeighborCells.h"
#include "Distributed/RankRun.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/TriangleSink.h"

#include <cmath>
#include <limits>

namespace tipp
{
namespace
{

/// Returns, on the first rank, about `wanted` of all ranks' points, evenly spaced on each rank.
/// Collective.
std::vector<Point2> gatherSample(
  Communicator& ranks, PointsView points, std::int64_t allPoints, std::size_t wanted)
{
  const double share = double(points.size()) / double(std::max<std::int64_t>(1, allPoints));
  return gatherList(
    ranks, samplePoints(points, static_cast<std::size_t>(std::ceil(share * double(wanted)))));
}

/// Converts internal ids to indices into Owned and, after these, Ghosts.
template <typename Id>
std::vector<typename TriangleSink<Id>::FinalTriangle> localised(
  const std::vector<IdTriangle>& triangles, const std::vector<std::int64_t>& ghosts,
  std::int64_t firstOwn, const Buffer<Point2>& positions, const Tiling& leaves)
{
  std::vector<typename TriangleSink<Id>::FinalTriangle> local;
  local.reserve(triangles.size());
  const auto indexOf = localIndices(firstOwn, positions.size(), ghosts);
  for (const IdTriangle& triangle : triangles)
  {
    typename TriangleSink<Id>::Corners ids;
    std::transform(triangle.begin(), triangle.end(), ids.begin(),
      [&indexOf](std::int64_t id) { return static_cast<Id>(indexOf(id)); });
    ids = TriangleSink<Id>::fromLowest(ids);
    local.push_back({ ids, leaves.locate(positions[std::size_t(ids[0])]) });
  }
  return local;
}

/// The step after all partitions are done: sends boundary triangles to the rank that owns their
/// vertex of lowest id, adds them to its interior triangles, and fetches the points that they use
/// from other ranks. Collective.
template <typename Id>
void collect(Communicator& ranks, OwnedPoints<Id>& points, const std::vector<IdTriangle>& kept,
  const std::vector<std::size_t>& interiorCounts, std::vector<Duplicate> duplicates,
  const Tiling& leaves, int threads, DistributedTriangulation& result)
{
  const std::size_t rowSize = result.RowSize;
  const std::int64_t firstOwn = points.FirstIds[std::size_t(ranks.rank())];
  result.FirstIds = points.FirstIds;
  const std::vector<IdTriangle> boundary = sendToOwners(ranks, kept, points.FirstIds);
  result.GhostIds = ghostIds(boundary, firstOwn, firstOwn + std::int64_t(points.size()));

  TriangleSink<Id> sink(points.Buckets);
  for (std::size_t leaf = 0; leaf < interiorCounts.size(); ++leaf)
  {
    sink.setInteriorCount(static_cast<PartitionIndex>(leaf), interiorCounts[leaf]);
  }
  Buffer<Id> ids = sink.assemble(
    { localised<Id>(boundary, result.GhostIds, firstOwn, points.Positions, leaves) }, threads);
  if constexpr (sizeof(Id) == 4)
  {
    result.Ids32 = std::move(ids);
  }
  else
  {
    result.Ids64 = std::move(ids);
  }

  result.Owned = std::move(static_cast<PointTuples&>(points));
  preferLowestGlobalIds(result.Owned, firstOwn, duplicates);
  result.Duplicates = std::move(duplicates);
  result.Ghosts = fetchPoints(ranks, result.GhostIds, points.FirstIds, result.Owned, rowSize);
}

/// One rank's run of the algorithm; its member functions are the steps.
class DistributedRun
{
public:
  DistributedRun(Communicator& ranks, const RankPoints& points, const DistributedOptions& options,
    DistributedTriangulation& result)
    : Ranks(ranks)
    , Input(points)
    , Options(options)
    , Result(result)
    , Threads(threadCount(options.Threads))
  {
    this->Result.RowSize = points.RowSize;
  }

  void run()
  {
    const Stopwatch watch;
    const InputSurvey survey =
      surveyRanks<2>(this->Ranks, this->Input, this->Result, this->Threads);
    this->Figures.InputPoints = std::int64_t(this->Input.Points.size());
    if (survey.dimension() < 2)
    {
      this->sortOutOnly(survey.Bounds);
    }
    else
    {
      this->triangulate(survey);
    }
    this->Result.divideBy(this->Input.Points.factor());
    this->Figures.TotalSeconds = watch.seconds();
    this->Figures.Triangles = std::int64_t(this->Result.triangleCount());
    setTotals(this->Ranks, this->Result.triangleCount(), this->Figures, this->Masters,
      this->Threads, this->Result);
  }

private:
  PlanInput planInput(const InputSurvey& survey)
  {
    PlanInput input;
    input.Domain = survey.Bounds;
    input.Points = this->Result.AllPoints;
    input.Ranks = this->Ranks.size();
    input.Threads = this->Ranks.size() * this->Threads;
    input.Sample = gatherSample(this->Ranks, this->Input.Points, this->Result.AllPoints,
      wantedSample(input.Points, this->Options, input.Threads));
    return input;
  }

  void triangulate(const InputSurvey& survey)
  {
    const Stopwatch watch;
    const PlanInput input = this->planInput(survey);
    const bool first = this->Ranks.rank() == 0;
    Plan plan = this->Ranks.broadcast(first ? divide(input, this->Options) : Plan());
    const PointExchange exchange(this->Input, plan.Leaves, this->Threads);
    std::vector<std::int64_t> counts = exchange.counts();
    this->Ranks.sum(counts);
    if (!plan.isAlone())
    {
      if (first)
      {
        assign(plan, input, counts, this->Options);
      }
      plan = this->Ranks.broadcast(plan);
    }
    std::int64_t own = 0;
    for (std::size_t leaf = 0; leaf < counts.size(); ++leaf)
    {
      own += plan.Owners[leaf] == this->Ranks.rank() ? counts[leaf] : 0;
    }
    // Half of the id range is left for other ranks' points.
    const bool fits = own < std::numeric_limits<std::int32_t>::max() / 2;
    const bool done = fits ? this->triangulate<std::int32_t>(plan, exchange, watch)
                           : this->triangulate<std::int64_t>(plan, exchange, watch);
    if (!done)
    {
      this->triangulateAlone(survey.Bounds, watch);
    }
  }

  /// Triangulates in partitions. Returns false, having done nothing, if partitioning does not pay
  /// off.
  template <typename Id>
  bool triangulate(const Plan& plan, const PointExchange& exchange, const Stopwatch& watch)
  {
    OwnedPoints<Id> points = exchange.exchange<Id>(this->Ranks, plan.Owners);
    this->Figures.ExchangeSeconds = watch.seconds();
    this->Figures.OwnedPoints = std::int64_t(points.size());
    if (plan.isAlone())
    {
      this->triangulateOnFirst(points, plan.Leaves);
      return true;
    }
    if (this->Options.isMasterless())
    {
      RankRun<Id> run(this->Ranks, plan, points, this->Options, this->Threads);
      return this->triangulate(run, plan, points);
    }
    MasterRun<Id> run(this->Ranks, plan, points, this->Options, this->Threads);
    const bool done = this->triangulate(run, plan, points);
    this->Masters = std::move(run.Masters);
    return done;
  }

  template <typename Id>
  bool triangulate(RankRun<Id>& run, const Plan& plan, OwnedPoints<Id>& points)
  {
    run.Statistics = this->Figures;
    run.run();
    if (!run.PartitionsPay)
    {
      return false;
    }
    this->Figures = run.Statistics;
    this->Result.Statistics.Partitions = plan.Leaves.size();
    this->Result.Statistics.MajorPartitions = plan.majors();
    const Stopwatch collecting;
    collect(this->Ranks, points, run.Kept, run.InteriorCounts, std::move(run.Duplicates),
      plan.Leaves, this->Threads, this->Result);
    this->Figures.CollectSeconds = collecting.seconds();
    return true;
  }

  /// Sends all points to the first rank.
  template <typename Id>
  OwnedPoints<Id> exchangeAlone(const Plan& plan)
  {
    return PointExchange(this->Input, plan.Leaves, this->Threads)
      .exchange<Id>(this->Ranks, plan.Owners);
  }

  void triangulateAlone(const Box2& domain, const Stopwatch& watch)
  {
    const Plan plan = planAlone(domain);
    OwnedPoints<std::int32_t> points = this->exchangeAlone<std::int32_t>(plan);
    this->Figures.ExchangeSeconds = watch.seconds();
    this->Figures.OwnedPoints = std::int64_t(points.size());
    this->triangulateOnFirst(points, plan.Leaves);
  }

  /// Triangulates on the first rank, which has all points.
  template <typename Id>
  void triangulateOnFirst(OwnedPoints<Id>& points, const Tiling& leaves)
  {
    const Stopwatch watch;
    std::vector<std::size_t> interiorCounts(1, 0);
    std::vector<Duplicate> duplicates;
    if (points.size() > 0)
    {
      Worker<Id> worker(leaves, points.Buckets);
      const double all = double(points.size());
      const auto& progress = this->Options.Progress;
      const bool done = worker.triangulateAlone(
        [&](std::size_t inserted) { return !progress || progress(double(inserted) / all); });
      if (!done)
      {
        throw RankFailure(this->Ranks.rank(), true, "The run was stopped.");
      }
      interiorCounts[0] = worker.interiorCount();
      duplicates = worker.duplicates();
      this->Figures.WorkerVertices = std::int64_t(worker.vertexCount());
      this->Figures.Partitions = 1;
    }
    this->Figures.ComputeSeconds = watch.seconds();
    this->Result.Statistics.Partitions = 1;
    collect(this->Ranks, points, {}, interiorCounts, std::move(duplicates), leaves, this->Threads,
      this->Result);
  }

  /// Finds the duplicates only, for input without triangles.
  void sortOutOnly(const Box2& bounds)
  {
    const Plan plan = planAlone(bounds);
    OwnedPoints<std::int64_t> points = this->exchangeAlone<std::int64_t>(plan);
    const Point2* positions = points.Positions.data();
    std::vector<Duplicate> duplicates =
      sortOutDuplicates(PointsView(points.size() > 0 ? &positions->x : nullptr, points.size(), 2));
    collect(this->Ranks, points, {}, std::vector<std::size_t>(1, 0), std::move(duplicates),
      plan.Leaves, this->Threads, this->Result);
  }

  Communicator& Ranks;
  RankPoints Input;
  const DistributedOptions& Options;
  DistributedTriangulation& Result;
  const int Threads;
  RankStatistics Figures;
  std::vector<MasterStatistics> Masters;
};

/// The triangles of all ranks on the first one, with idOf(index) for each corner.
template <typename IdOf>
Buffer<std::int64_t> gatherCorners(
  Communicator& ranks, const DistributedTriangulation& mine, const IdOf& idOf)
{
  Buffer<std::int64_t> ids(3 * mine.triangleCount());
  std::int64_t* to = ids.data();
  mine.forEachCorner([&](std::int64_t index) { *to++ = idOf(index); });
  return gatherValues(ranks, std::move(ids));
}

} // namespace

DistributedTriangulation triangulateDistributed(
  Communicator& ranks, const RankPoints& points, const DistributedOptions& options)
{
  return runTogether<DistributedRun, DistributedTriangulation>(ranks, points, options);
}

std::vector<IdTriangle> trianglesByIds(const DistributedTriangulation& mine, int rank)
{
  const auto idOf = internalIds(mine, rank);
  std::vector<IdTriangle> triangles(mine.triangleCount());
  std::size_t corner = 0;
  mine.forEachCorner(
    [&](std::int64_t index)
    {
      triangles[corner / 3][corner % 3] = idOf(index);
      ++corner;
    });
  return triangles;
}

void leaveOutLong(Communicator& ranks, double longest, DistributedTriangulation& mine)
{
  longest = ranks.broadcast(longest); // ranks may differ, but must do the same
  if (!(longest > 0))
  {
    return;
  }
  const std::vector<Point2> positions = mine.positions();
  const auto leaveOut = [&](auto& ids)
  {
    ids.truncate(3 *
      dropLongTriangles(ids.data(), ids.size() / 3, longest,
        [&positions](auto index) { return positions[std::size_t(index)]; }));
    addCells(ranks, std::vector<IdTriangle>(), ids, mine); // removes points without triangles
  };
  mine.Ids64.size() == 0 ? leaveOut(mine.Ids32) : leaveOut(mine.Ids64);
  numberCells(ranks, mine.triangleCount(), mine);
}

Buffer<std::int64_t> neighborIds(
  Communicator& ranks, const DistributedTriangulation& mine, const GhostTriangles& ghosts)
{
  return neighborIdsOf(ranks, mine, trianglesByIds(mine, ranks.rank()), ghosts, 3);
}

GhostTriangles fetchGhosts(Communicator& ranks, const DistributedTriangulation& mine)
{
  return fetchGhosts<Point2>(ranks, mine, trianglesByIds(mine, ranks.rank()));
}

DistributedTriangulation gatherOnFirst(Communicator& ranks, DistributedTriangulation mine)
{
  mine.Ids64 = gatherCorners(ranks, mine, internalIds(mine, ranks.rank()));
  mine.Ids32 = {};
  gatherPoints(ranks, mine);
  mine.FirstCell = ranks.isFirst() ? 0 : mine.AllCells;
  return mine;
}

Triangulation gatherTriangles(Communicator& ranks, const DistributedTriangulation& mine)
{
  Triangulation result;
  result.Ids64 = gatherCorners(ranks, mine, globalIds(mine));
  gatherDuplicatesAndRejected(ranks, mine, result);
  return result;
}

} // namespace tipp
