// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/ConstraintJobs.h"

#include "Arrays/DisjointSets.h"
#include "Arrays/IndexMap.h"
#include "Constraints/Insertion/ConstraintRegion.h"
#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <array>
#include <deque>
#include <iterator>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

/// The crossed triangles by job: their indices in CrossedTriangles::Triangles.
using JobTriangles = GroupedItems<std::int64_t>;

JobTriangles sortByJob(const CrossedTriangles& crossed)
{
  const std::vector<std::int64_t> jobs = jobsOfTriangles(crossed);
  const auto last = std::max_element(jobs.begin(), jobs.end());
  return { last == jobs.end() ? 0 : std::size_t(*last) + 1, 1,
    [&](const auto& visit)
    {
      for (std::size_t t = 0; t < jobs.size(); ++t)
      {
        visit(std::size_t(jobs[t]), std::int64_t(t));
      }
    } };
}

/// A thread's workspace for retriangulation.
template <typename Id>
class JobWorker
{
public:
  using Corners = std::array<PointId, 3>;

  /// `known` are constraints that may already be edges between triangles of a job.
  JobWorker(PointsView points, Id* triangles, const CrossedTriangles& crossed,
    const JobTriangles& jobs, const SplitSegments& split, const ConstraintEdges& known)
    : Points(points)
    , Triangles(triangles)
    , Crossed(crossed)
    , Jobs(jobs)
    , Split(split)
    , Known(known)
  {
  }

  /// Runs the jobs [begin, end).
  void run(std::size_t begin, std::size_t end)
  {
    this->load(this->Jobs.begin(begin), this->Jobs.begin(end));
    const LocatedTriangle* loaded = this->Loaded.data();
    for (std::size_t job = begin; job < end; ++job)
    {
      this->retriangulate(loaded, this->Jobs.begin(job), this->Jobs.end(job));
      loaded += this->Jobs.end(job) - this->Jobs.begin(job);
    }
  }

private:
  struct LocatedTriangle
  {
    Corners Ids;
    std::array<Point2, 3> Positions;
  };

  /// Copies the triangles of all jobs first. They and their points are scattered in memory, and
  /// independent loads overlap.
  void load(const std::int64_t* first, const std::int64_t* last)
  {
    this->Loaded.clear();
    for (const std::int64_t* t = first; t != last; ++t)
    {
      const Id* const ids = this->corners(*t);
      this->Loaded.push_back({ { ids[0], ids[1], ids[2] }, {} });
    }
    for (LocatedTriangle& triangle : this->Loaded)
    {
      std::transform(triangle.Ids.begin(), triangle.Ids.end(), triangle.Positions.begin(),
        [this](PointId id) { return this->Points[std::size_t(id)]; });
    }
  }

  /// Replaces the triangles [first, last) of a job.
  void retriangulate(
    const LocatedTriangle* loaded, const std::int64_t* first, const std::int64_t* last)
  {
    this->Region.clear();
    this->Segments.clear();
    for (const std::int64_t* t = first; t != last; ++t, ++loaded)
    {
      this->Region.add(loaded->Ids, loaded->Positions);
      this->Segments.insert(
        this->Segments.end(), this->Crossed.begin(*t), this->Crossed.begin(*t + 1));
    }
    this->Region.finish();
    this->Region.fixEdges([this](PointId a, PointId b) { return this->Known.contains(a, b); });
    sortUnique(this->Segments);
    for (const std::int64_t segment : this->Segments)
    {
      std::for_each(this->Split.begin(std::size_t(segment)), this->Split.end(std::size_t(segment)),
        [this](const IdSegment& part) { this->Region.insert(part.A, part.B); });
    }
    this->New.clear();
    for (std::size_t t = 0; t < this->Region.triangleCount(); ++t)
    {
      this->New.push_back(TriangleSink<PointId>::fromLowest(this->Region.triangle(t)));
    }
    std::sort(this->New.begin(), this->New.end());
    for (const Corners& ids : this->New)
    {
      std::transform(
        ids.begin(), ids.end(), this->corners(*first++), [](PointId id) { return Id(id); });
    }
  }

  Id* corners(std::int64_t crossed) const
  {
    return this->Triangles + 3 * this->Crossed.Triangles[std::size_t(crossed)];
  }

  PointsView Points;
  Id* Triangles;
  const CrossedTriangles& Crossed;
  const JobTriangles& Jobs;
  const SplitSegments& Split;
  const ConstraintEdges& Known;
  std::vector<LocatedTriangle> Loaded; ///< of several jobs
  ConstraintRegion Region;
  std::vector<std::int64_t> Segments; ///< that cross the job's triangles
  std::vector<Corners> New;
};

} // namespace

SplitSegments splitSegments(PointsView points, std::vector<IdSegment>& segments,
  const std::vector<CrossedTriangles::Touch>& touches)
{
  SplitSegments split;
  if (touches.empty())
  {
    split.Parts = std::move(segments);
    return split;
  }
  const auto at = [&](PointId id) { return points[std::size_t(id)]; };
  split.Parts.reserve(segments.size() + touches.size());
  split.Starts.reserve(segments.size() + 1);
  auto touch = touches.begin();
  std::vector<PointId> vertices;
  for (std::size_t p = 0; p < segments.size(); ++p)
  {
    const IdSegment& segment = segments[p];
    vertices.clear();
    for (; touch != touches.end() && touch->Segment == std::int64_t(p); ++touch)
    {
      vertices.push_back(touch->Vertex);
    }
    if (!vertices.empty()) // seldom; positions are anywhere in memory
    {
      const bool isAscending = lexicographicLess(at(segment.A), at(segment.B));
      std::sort(vertices.begin(), vertices.end(),
        [&](PointId a, PointId b) {
          return isAscending ? lexicographicLess(at(a), at(b)) : lexicographicLess(at(b), at(a));
        });
    }
    vertices.push_back(segment.B);
    split.Starts.push_back(std::int64_t(split.Parts.size()));
    PointId from = segment.A;
    for (const PointId to : vertices)
    {
      split.Parts.push_back({ from, to, segment.Constraint });
      from = to;
    }
  }
  split.Starts.push_back(std::int64_t(split.Parts.size()));
  return split;
}

std::vector<std::int64_t> jobsOfTriangles(const CrossedTriangles& crossed)
{
  IndexMap numbers;                   // of the segments; only a few of all segments are left
  std::vector<std::int64_t> segments; // as crossed.Segments, but numbers
  segments.reserve(crossed.Segments.size());
  std::transform(crossed.Segments.begin(), crossed.Segments.end(), std::back_inserter(segments),
    [&numbers](std::int64_t segment) { return numbers.insert(segment).Index; });
  std::vector<std::int64_t> sets(numbers.size()); // of segments
  std::iota(sets.begin(), sets.end(), std::int64_t(0));
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    for (std::int64_t i = crossed.Starts[t] + 1; i < crossed.Starts[t + 1]; ++i)
    {
      joinIn(sets, segments[std::size_t(crossed.Starts[t])], segments[std::size_t(i)]);
    }
  }
  // Jobs are in the order of their first triangles, so that a job's memory is near that of the one
  // before.
  IndexMap jobs;
  std::vector<std::int64_t> result;
  result.reserve(crossed.Triangles.size());
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    const std::int64_t first = segments[std::size_t(crossed.Starts[t])];
    result.push_back(jobs.insert(rootIn(sets, first)).Index);
  }
  return result;
}

template <typename Id>
void retriangulateJobs(PointsView points, Id* triangles, const CrossedTriangles& crossed,
  const SplitSegments& split, const ConstraintEdges& known, int threads)
{
  const JobTriangles jobs = sortByJob(crossed);
  std::deque<JobWorker<Id>> workers;
  for (int thread = 0; thread < threads; ++thread)
  {
    workers.emplace_back(points, triangles, crossed, jobs, split, known);
  }
  constexpr std::int64_t chunk = 256;
  forChunks(std::int64_t(jobs.groups()), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    { workers[std::size_t(thread)].run(std::size_t(begin), std::size_t(end)); });
}

template void retriangulateJobs(PointsView, std::int32_t*, const CrossedTriangles&,
  const SplitSegments&, const ConstraintEdges&, int);
template void retriangulateJobs(PointsView, std::int64_t*, const CrossedTriangles&,
  const SplitSegments&, const ConstraintEdges&, int);

} // namespace tipp
