// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/DistributedTriangulation.h"

#include "Distributed/Plan.h"
#include "Distributed/RankRun.h"
#include "Distributed/TriangleExchange.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointSurvey.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Worker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <omp.h>

namespace tipp
{

template <typename Archive>
void serialize(Archive& archive, MasterStatistics& master)
{
  archive(master.Area, master.Rank, master.GroupSize, master.LargestMesh, master.Seconds,
    master.PathSeconds, master.Stages);
}

namespace
{

std::string nameOf(MessageKind kind)
{
  const std::map<MessageKind, std::string> names = { { MessageKind::AllToAll, "all to all" },
    { MessageKind::Gather, "gather" }, { MessageKind::Broadcast, "broadcast" },
    { MessageKind::Sum, "sum" }, { PartitionDoneMessage, "partition done" },
    { TaskMessage, "task" } };
  const auto name = names.find(kind);
  return name != names.end() ? name->second : "other";
}

struct SentByKind
{
  MessageKind Kind;
  Communicator::Traffic Sent;
};

/// What a rank reports to the others for the statistics.
struct StatisticsOfRank
{
  RankStatistics Own;
  std::vector<MasterStatistics> Masters;
  std::vector<SentByKind> Traffic;
};

template <typename Archive>
void serialize(Archive& archive, StatisticsOfRank& one)
{
  archive(one.Own, one.Masters, one.Traffic);
}

} // namespace

DistributedStatistics gatherStatistics(
  Communicator& ranks, const RankStatistics& own, const std::vector<MasterStatistics>& masters)
{
  StatisticsOfRank mine{ own, masters, {} };
  for (const auto& [kind, sent] : ranks.traffic())
  {
    mine.Traffic.push_back({ kind, sent });
  }
  DistributedStatistics statistics;
  std::map<MessageKind, Communicator::Traffic> traffic;
  for (const StatisticsOfRank& one : ranks.allGather(mine))
  {
    statistics.Ranks.push_back(one.Own);
    statistics.Masters.insert(statistics.Masters.end(), one.Masters.begin(), one.Masters.end());
    for (const SentByKind& of : one.Traffic)
    {
      traffic[of.Kind].Messages += of.Sent.Messages;
      traffic[of.Kind].Bytes += of.Sent.Bytes;
    }
    statistics.Seconds = std::max(statistics.Seconds, one.Own.TotalSeconds);
  }
  for (const auto& [kind, sum] : traffic)
  {
    statistics.Traffic.push_back({ nameOf(kind), sum.Messages, sum.Bytes });
  }
  std::sort(statistics.Masters.begin(), statistics.Masters.end(),
    [](const MasterStatistics& a, const MasterStatistics& b) { return a.Area < b.Area; });
  return statistics;
}

namespace
{

/// The result of the first pass over all ranks' points.
struct Survey
{
  PointsView Points;                  ///< this rank's, scaled to a moderate magnitude
  Box2 Bounds{};                      ///< bounds of all ranks' finite points
  std::vector<std::int64_t> Rejected; ///< indices of this rank's points that are not finite
  bool IsCollinear = false;           ///< all finite points on one line, or fewer than three
};

/// What a rank sends to the first rank about its points. Two points represent a rank's points if
/// these are collinear.
struct RankSurvey
{
  Box2 Bounds;
  Point2 Ends[2];
  std::int64_t Finite;
  std::int64_t IsCollinear;
};

struct Verdict
{
  Box2 Bounds;
  std::int64_t IsCollinear;
};

void findEnds(PointsView points, Point2 (&ends)[2])
{
  bool found = false;
  points.forEach(0, points.size(),
    [&](std::size_t, Point2 p)
    {
      if (!isFinite(p))
      {
        return;
      }
      ends[0] = !found || lexicographicLess(p, ends[0]) ? p : ends[0];
      ends[1] = !found || lexicographicLess(ends[1], p) ? p : ends[1];
      found = true;
    });
}

Verdict judge(const std::vector<RankSurvey>& surveys)
{
  Verdict verdict{ { HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL }, 1 };
  std::vector<Point2> ends;
  for (const RankSurvey& survey : surveys)
  {
    if (survey.Finite == 0)
    {
      continue;
    }
    verdict.Bounds = unionOf(verdict.Bounds, survey.Bounds);
    verdict.IsCollinear = verdict.IsCollinear && survey.IsCollinear;
    ends.insert(ends.end(), { survey.Ends[0], survey.Ends[1] });
  }
  if (ends.empty())
  {
    verdict.Bounds = {};
  }
  else if (verdict.IsCollinear)
  {
    verdict.IsCollinear = areCollinear(PointsView(ends));
  }
  return verdict;
}

/// Surveys all ranks' points. Collective.
Survey surveyRanks(Communicator& ranks, PointsView points, int threads)
{
  PointSurvey local = surveyPoints(points, threads);
  Survey survey;
  survey.Points = points;
  survey.Rejected = std::move(local.Rejected);
  RankSurvey own{};
  own.Bounds = local.Bounds;
  own.Finite = std::int64_t(points.size() - survey.Rejected.size());
  own.IsCollinear = areCollinear(points);
  if (own.IsCollinear)
  {
    findEnds(points, own.Ends);
  }
  const std::vector<RankSurvey> all = ranks.gather(own);
  const Verdict verdict = ranks.broadcast(judge(all));
  survey.Bounds = verdict.Bounds;
  survey.IsCollinear = verdict.IsCollinear != 0;

  // All ranks must scale, or none.
  const PointsView moderate = withModerateMagnitude(points, survey.Bounds);
  std::vector<std::int64_t> kept = { moderate.factor() == 1 };
  ranks.sum(kept);
  if (kept[0] == 0)
  {
    survey.Points = moderate;
    survey.Bounds = scaled(survey.Bounds, moderate.factor());
  }
  return survey;
}

/// Returns, on the first rank, about `wanted` of all ranks' points, evenly spaced on each rank.
/// Collective.
std::vector<Point2> gatherSample(
  Communicator& ranks, PointsView points, std::int64_t allPoints, std::size_t wanted)
{
  const double share = double(points.size()) / double(std::max<std::int64_t>(1, allPoints));
  std::vector<Point2> sample;
  for (const std::vector<Point2>& part :
    ranks.gather(samplePoints(points, static_cast<std::size_t>(std::ceil(share * double(wanted))))))
  {
    sample.insert(sample.end(), part.begin(), part.end());
  }
  return sample;
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
    this->numberPoints();
    const Survey survey = surveyRanks(this->Ranks, this->Input.Points, this->Threads);
    this->Input.Points = survey.Points;
    this->Figures.InputPoints = std::int64_t(this->Input.Points.size());
    for (const std::int64_t i : survey.Rejected)
    {
      this->Result.Rejected.push_back(this->Input.globalId(std::size_t(i)));
    }
    if (survey.IsCollinear)
    {
      this->sortOutOnly(survey.Bounds);
    }
    else
    {
      this->triangulate(survey);
    }
    this->restoreMagnitude(survey.Points.factor());
    this->Figures.TotalSeconds = watch.seconds();
    this->finish();
  }

private:
  void numberPoints()
  {
    const std::vector<std::int64_t> firsts =
      firstIndices(this->Ranks, std::int64_t(this->Input.Points.size()));
    this->Input.FirstId = firsts[std::size_t(this->Ranks.rank())];
    this->Result.AllPoints = firsts.back();
  }

  PlanInput planInput(const Survey& survey)
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

  void triangulate(const Survey& survey)
  {
    const Stopwatch watch;
    const PlanInput input = this->planInput(survey);
    const bool first = this->Ranks.rank() == 0;
    Plan plan = this->Ranks.broadcast(first ? divide(input, this->Options) : Plan());
    const PointExchange exchange(this->Input, plan.Leaves, this->Threads);
    std::vector<std::int64_t> counts = exchange.counts();
    this->Ranks.sum(counts);
    if (!plan.IsAlone)
    {
      if (first)
      {
        assign(plan, input, counts, this->Options);
      }
      plan = this->Ranks.broadcast(plan);
    }
    this->LocalCount = 0;
    for (std::size_t leaf = 0; leaf < counts.size(); ++leaf)
    {
      this->LocalCount += plan.Owners[leaf] == this->Ranks.rank() ? counts[leaf] : 0;
    }
    // Half of the id range is left for other ranks' points.
    const bool fits = this->LocalCount < std::numeric_limits<std::int32_t>::max() / 2;
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
    if (plan.IsAlone)
    {
      this->triangulateOnFirst(points, plan.Leaves);
      return true;
    }
    RankRun<Id> run(this->Ranks, plan, points, this->Options, this->Threads);
    const bool done = this->runAndCollect(run, plan, points);
    this->Masters = std::move(run.Masters);
    return done;
  }

  template <typename Id>
  bool runAndCollect(RankRun<Id>& run, const Plan& plan, OwnedPoints<Id>& points)
  {
    run.Statistics = this->Figures;
    run.run();
    if (!run.PartitionsPay)
    {
      return false;
    }
    this->Figures = run.Statistics;
    this->Result.Statistics.Partitions = plan.Leaves.size();
    this->Result.Statistics.MajorPartitions =
      plan.Areas.front().hasLeaves() ? 0 : plan.Areas.front().Inner;
    const Stopwatch collecting;
    collect(this->Ranks, points, run.Kept, run.InteriorCounts, std::move(run.Duplicates),
      plan.Leaves, this->Threads, this->Result);
    this->Figures.CollectSeconds = collecting.seconds();
    return true;
  }

  void triangulateAlone(const Box2& domain, const Stopwatch& watch)
  {
    const Plan plan = planAlone(domain);
    const PointExchange exchange(this->Input, plan.Leaves, this->Threads);
    OwnedPoints<std::int32_t> points = exchange.exchange<std::int32_t>(this->Ranks, plan.Owners);
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
    const PointExchange exchange(this->Input, plan.Leaves, this->Threads);
    OwnedPoints<std::int64_t> points = exchange.exchange<std::int64_t>(this->Ranks, plan.Owners);
    const Point2* positions = points.Positions.data();
    std::vector<Duplicate> duplicates =
      sortOutDuplicates(PointsView(points.size() > 0 ? &positions->x : nullptr, points.size(), 2));
    collect(this->Ranks, points, {}, std::vector<std::size_t>(1, 0), std::move(duplicates),
      plan.Leaves, this->Threads, this->Result);
  }

  void restoreMagnitude(double factor)
  {
    if (factor != 1)
    {
      for (Buffer<Point2>* positions :
        { &this->Result.Owned.Positions, &this->Result.Ghosts.Positions })
      {
        std::transform(positions->begin(), positions->end(), positions->begin(),
          [factor](Point2 p) {
            return Point2{ p.x / factor, p.y / factor };
          });
      }
    }
  }

  void finish()
  {
    std::vector<std::int64_t> triangles(static_cast<std::size_t>(this->Ranks.size()) + 2, 0);
    triangles[std::size_t(this->Ranks.rank())] = std::int64_t(this->Result.triangleCount());
    triangles[triangles.size() - 2] = std::int64_t(this->Result.Duplicates.size());
    triangles.back() = std::int64_t(this->Result.Rejected.size());
    this->Ranks.sum(triangles);
    const auto end = triangles.end() - 2;
    this->Result.FirstTriangle =
      std::accumulate(triangles.begin(), triangles.begin() + this->Ranks.rank(), std::int64_t(0));
    this->Result.AllTriangles = std::accumulate(triangles.begin(), end, std::int64_t(0));
    this->Result.AllDuplicates = *end;
    this->Result.AllRejected = triangles.back();
    this->Figures.Triangles = std::int64_t(this->Result.triangleCount());
    this->Figures.SendSeconds = this->Ranks.sendingSeconds();
    DistributedStatistics& statistics = this->Result.Statistics;
    const std::int64_t partitions = statistics.Partitions;
    const std::int64_t majors = statistics.MajorPartitions;
    statistics = gatherStatistics(this->Ranks, this->Figures, this->Masters);
    statistics.Partitions = partitions;
    statistics.MajorPartitions = majors;
    statistics.ThreadsPerRank = this->Threads;
  }

  Communicator& Ranks;
  RankPoints Input;
  const DistributedOptions& Options;
  DistributedTriangulation& Result;
  const int Threads;
  std::int64_t LocalCount = 0;
  RankStatistics Figures;
  std::vector<MasterStatistics> Masters;
};

} // namespace

DistributedTriangulation triangulateDistributed(
  Communicator& ranks, const RankPoints& points, const DistributedOptions& options)
{
  DistributedTriangulation result;
  ranks.together([&]() { DistributedRun(ranks, points, options, result).run(); });
  return result;
}

} // namespace tipp
