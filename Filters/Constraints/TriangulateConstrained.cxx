// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/TriangulateConstrained.h"

#include "Constraints/ConstraintRegion.h"
#include "Constraints/CrossedTriangles.h"
#include "Constraints/PartitionConstraints.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace tipp
{

namespace
{

/// Lists of numbers, concatenated.
struct Lists
{
  std::vector<std::int64_t> Starts; ///< and the end
  std::vector<std::int64_t> Items;

  const std::int64_t* begin(std::size_t list) const
  {
    return this->Items.data() + this->Starts[list];
  }
  const std::int64_t* end(std::size_t list) const
  {
    return this->Items.data() + this->Starts[list + 1];
  }
  std::size_t size(std::size_t list) const
  {
    return std::size_t(this->Starts[list + 1] - this->Starts[list]);
  }
};

/// For each list the indices i with names[i] equal to its number, ascending; a negative name is in
/// no list.
Lists listsOf(const std::vector<std::int64_t>& names, std::size_t lists)
{
  Lists result;
  result.Starts.assign(lists + 1, 0);
  for (const std::int64_t list : names)
  {
    result.Starts[std::size_t(list + 1)] += list >= 0 ? 1 : 0;
  }
  std::partial_sum(result.Starts.begin(), result.Starts.end(), result.Starts.begin());
  result.Items.resize(std::size_t(result.Starts.back()));
  std::vector<std::int64_t> next = result.Starts;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (names[i] >= 0)
    {
      result.Items[std::size_t(next[std::size_t(names[i])]++)] = std::int64_t(i);
    }
  }
  return result;
}

/// Sets of pieces, joined one by one.
class PieceSets
{
public:
  explicit PieceSets(std::size_t pieces)
    : Parents(pieces)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), std::int64_t(0));
  }

  /// The lowest piece of its set.
  std::int64_t find(std::int64_t piece)
  {
    while (this->parent(piece) != piece)
    {
      this->parent(piece) = this->parent(this->parent(piece));
      piece = this->parent(piece);
    }
    return piece;
  }

  void join(std::int64_t a, std::int64_t b)
  {
    const auto [low, high] = std::minmax({ this->find(a), this->find(b) });
    this->parent(high) = low;
  }

private:
  std::int64_t& parent(std::int64_t piece) { return this->Parents[std::size_t(piece)]; }

  std::vector<std::int64_t> Parents;
};

/// The jobs: what is retriangulated together.
struct Jobs
{
  std::size_t Count = 0;
  Lists Triangles; ///< positions in CrossedTriangles::Triangles
  Lists Pieces;
};

Jobs makeJobs(const CrossedTriangles& crossed, std::size_t pieces)
{
  PieceSets sets(pieces);
  std::vector<char> crosses(pieces, 0);
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    const std::int64_t first = crossed.Pieces[std::size_t(crossed.Starts[t])];
    for (std::int64_t i = crossed.Starts[t]; i < crossed.Starts[t + 1]; ++i)
    {
      const std::int64_t piece = crossed.Pieces[std::size_t(i)];
      crosses[std::size_t(piece)] = 1;
      sets.join(first, piece);
    }
  }
  Jobs jobs;
  constexpr std::int64_t none = -1;
  std::vector<std::int64_t> jobOfPiece(pieces, none);
  for (std::size_t p = 0; p < pieces; ++p)
  {
    if (crosses[p])
    {
      const auto first = std::size_t(sets.find(std::int64_t(p)));
      jobOfPiece[p] = first == p ? std::int64_t(jobs.Count++) : jobOfPiece[first];
    }
  }
  std::vector<std::int64_t> jobOfTriangle(crossed.Triangles.size());
  for (std::size_t t = 0; t < jobOfTriangle.size(); ++t)
  {
    jobOfTriangle[t] = jobOfPiece[std::size_t(crossed.Pieces[std::size_t(crossed.Starts[t])])];
  }
  jobs.Triangles = listsOf(jobOfTriangle, jobs.Count);
  jobs.Pieces = listsOf(jobOfPiece, jobs.Count);
  return jobs;
}

/// The pieces' parts between the vertices that lie on them.
struct SplitPieces
{
  std::vector<ConstraintPiece> Parts;
  std::vector<std::int64_t> Starts; ///< of each piece's parts, and the end; empty: one each
};

SplitPieces splitPieces(PointsView points, std::vector<ConstraintPiece>& pieces,
  const std::vector<CrossedTriangles::Touch>& touches)
{
  SplitPieces split;
  if (touches.empty())
  {
    split.Parts = std::move(pieces);
    return split;
  }
  const auto at = [&](PointId id) { return points[std::size_t(id)]; };
  auto touch = touches.begin();
  std::vector<PointId> vertices;
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    const ConstraintPiece& piece = pieces[p];
    const bool isAscending = lexicographicLess(at(piece.A), at(piece.B));
    vertices.clear();
    for (; touch != touches.end() && touch->Piece == std::int64_t(p); ++touch)
    {
      vertices.push_back(touch->Vertex);
    }
    std::sort(vertices.begin(), vertices.end(),
      [&](PointId a, PointId b)
      { return isAscending ? lexicographicLess(at(a), at(b)) : lexicographicLess(at(b), at(a)); });
    vertices.push_back(piece.B);
    split.Starts.push_back(std::int64_t(split.Parts.size()));
    PointId from = piece.A;
    for (const PointId to : vertices)
    {
      split.Parts.push_back({ from, to, piece.Constraint });
      from = to;
    }
  }
  split.Starts.push_back(std::int64_t(split.Parts.size()));
  return split;
}

/// A thread's workspace for jobs.
template <typename Id>
class JobWorker
{
public:
  using Corners = std::array<PointId, 3>;

  /// `known` are constraints that may be edges between the jobs' triangles.
  JobWorker(PointsView points, Id* triangles, const CrossedTriangles& crossed, const Jobs& jobs,
    const SplitPieces& split, const ConstraintEdges& known)
    : Points(points)
    , Triangles(triangles)
    , Crossed(crossed)
    , All(jobs)
    , Split(split)
    , Known(known)
  {
  }

  void run(std::size_t job)
  {
    if (this->All.Triangles.size(job) == 2)
    {
      this->exchangeDiagonal(job);
      return;
    }
    this->Region.clear();
    std::for_each(this->All.Triangles.begin(job), this->All.Triangles.end(job),
      [this](std::int64_t t) { this->addTriangle(this->corners(t)); });
    this->Region.finish();
    this->Region.fixEdges([this](PointId a, PointId b) { return this->Known.contains(a, b); });
    std::for_each(this->All.Pieces.begin(job), this->All.Pieces.end(job),
      [this](std::int64_t piece) { this->insertPiece(std::size_t(piece)); });
    this->New.clear();
    for (std::size_t t = 0; t < this->Region.triangleCount(); ++t)
    {
      this->New.push_back(fromLowest(this->Region.triangle(t)));
    }
    std::sort(this->New.begin(), this->New.end());
    for (std::size_t i = 0; i < this->New.size(); ++i)
    {
      this->store(this->All.Triangles.begin(job)[i], this->New[i]);
    }
  }

private:
  Id* corners(std::int64_t crossed) const
  {
    return this->Triangles + 3 * this->Crossed.Triangles[std::size_t(crossed)];
  }

  void store(std::int64_t crossed, const Corners& ids) const
  {
    std::transform(
      ids.begin(), ids.end(), this->corners(crossed), [](PointId id) { return Id(id); });
  }

  static Corners fromLowest(Corners ids)
  {
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  void addTriangle(const Id* ids)
  {
    this->Region.add({ PointId(ids[0]), PointId(ids[1]), PointId(ids[2]) },
      { this->Points[std::size_t(ids[0])], this->Points[std::size_t(ids[1])],
        this->Points[std::size_t(ids[2])] });
  }

  void insertPiece(std::size_t piece)
  {
    const bool isWhole = this->Split.Starts.empty();
    const std::size_t begin = isWhole ? piece : std::size_t(this->Split.Starts[piece]);
    const std::size_t end = isWhole ? piece + 1 : std::size_t(this->Split.Starts[piece + 1]);
    for (std::size_t part = begin; part < end; ++part)
    {
      this->Region.insert(this->Split.Parts[part].A, this->Split.Parts[part].B);
    }
  }

  /// Most jobs: the only segment joins the far corners of two triangles.
  void exchangeDiagonal(std::size_t job) const
  {
    const std::int64_t* const both = this->All.Triangles.begin(job);
    const Id* one = this->corners(both[0]);
    const Id* other = this->corners(both[1]);
    const auto far = std::find_if(
      one, one + 3, [&](Id id) { return std::find(other, other + 3, id) == other + 3; });
    const auto beyond =
      std::find_if(other, other + 3, [&](Id id) { return std::find(one, one + 3, id) == one + 3; });
    const PointId a = *far;
    const PointId b = *beyond;
    const PointId right = one[(far - one + 1) % 3];
    const PointId left = one[(far - one + 2) % 3];
    const auto [low, high] =
      std::minmax({ fromLowest({ a, right, b }), fromLowest({ a, b, left }) });
    this->store(both[0], low);
    this->store(both[1], high);
  }

  PointsView Points;
  Id* Triangles;
  const CrossedTriangles& Crossed;
  const Jobs& All;
  const SplitPieces& Split;
  const ConstraintEdges& Known;
  ConstraintRegion Region;
  std::vector<Corners> New;
};

/// The parts with both ends at vertices of crossed triangles.
template <typename Id>
ConstraintEdges edgesNear(
  const CrossedTriangles& crossed, const Id* triangles, const std::vector<ConstraintPiece>& parts)
{
  constexpr std::size_t marks = std::size_t(1) << 20; // by the ids' last digits
  std::vector<char> isVertex(marks, 0);
  for (const std::int64_t t : crossed.Triangles)
  {
    std::for_each_n(triangles + 3 * t, 3, [&](Id id) { isVertex[std::size_t(id) % marks] = 1; });
  }
  std::vector<ConstraintPiece> near;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(near),
    [&](const ConstraintPiece& part)
    { return isVertex[std::size_t(part.A) % marks] && isVertex[std::size_t(part.B) % marks]; });
  return ConstraintEdges(near);
}

template <typename Id>
void constrainTriangles(PointsView points, Buffer<Id>& ids,
  const std::vector<TriangleBlock>& blocks, std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, int threads)
{
  const CrossedTriangles crossed =
    findCrossedTriangles(points, ids.data(), ids.size() / 3, blocks, pieces, inserted, threads);
  const Jobs jobs = makeJobs(crossed, pieces.size());
  SplitPieces split = splitPieces(points, pieces, crossed.Touches);
  const ConstraintEdges known = edgesNear(crossed, ids.data(), split.Parts);
  std::vector<JobWorker<Id>> workers(
    std::size_t(threads), JobWorker<Id>(points, ids.data(), crossed, jobs, split, known));
  constexpr std::int64_t chunk = 256;
  forChunks(std::int64_t(jobs.Count), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t job = begin; job < end; ++job)
      {
        workers[std::size_t(thread)].run(std::size_t(job));
      }
    });
  pieces = std::move(split.Parts);
}

/// Replaces the ends of pieces by their representatives.
void nameRepresentatives(const std::vector<Duplicate>& duplicates,
  std::vector<ConstraintPiece>& pieces, std::vector<CrossedTriangles::Touch>& touches)
{
  const auto representative = [&](PointId id)
  {
    const auto found = std::lower_bound(duplicates.begin(), duplicates.end(), id,
      [](const Duplicate& duplicate, PointId wanted) { return duplicate.Point < wanted; });
    return found != duplicates.end() && found->Point == id ? found->Representative : id;
  };
  if (!duplicates.empty())
  {
    for (ConstraintPiece& piece : pieces)
    {
      piece.A = representative(piece.A);
      piece.B = representative(piece.B);
    }
    for (CrossedTriangles::Touch& touch : touches)
    {
      touch.Vertex = representative(touch.Vertex);
    }
  }
}

/// Turns the triangulation of points, in which some of these pieces were inserted already, into the
/// constrained Delaunay triangulation of all, in place. No piece crosses another. Afterwards pieces
/// name the points that stand for their ends, and are split at vertices that lie on them.
///
/// Only triangles that a piece crosses change. Pieces that cross the same triangle form one job
/// with the triangles that they cross; jobs do not depend on each other. The new triangles of a job
/// take the positions of the old ones, both in their order, so that the result is the same for any
/// number of threads.
void constrain(PointsView points, Triangulation& triangulation,
  std::vector<ConstraintPiece>& pieces, PartitionConstraints& inserted, int threads)
{
  nameRepresentatives(triangulation.Duplicates, pieces, inserted.touches());
  if (pieces.empty() || triangulation.triangleCount() == 0)
  {
    return;
  }
  if (triangulation.Ids64.empty())
  {
    constrainTriangles(
      points, triangulation.Ids32, triangulation.Blocks, pieces, inserted, threads);
  }
  else
  {
    constrainTriangles(
      points, triangulation.Ids64, triangulation.Blocks, pieces, inserted, threads);
  }
}

/// The input's points and the crossings.
std::vector<Point2> allPoints(PointsView points, const std::vector<CrossingPoint>& crossings)
{
  std::vector<Point2> all;
  all.reserve(points.size() + crossings.size());
  points.forEach(0, points.size(), [&all](std::size_t, Point2 p) { all.push_back(p); });
  for (const CrossingPoint& crossing : crossings)
  {
    all.push_back(crossing.Position);
  }
  return all;
}

} // namespace

ConstrainedTriangulation triangulateConstrained(PointsView input,
  const std::vector<Constraint>& constraints, CrossingRule crossings,
  const TriangulationOptions& options, const std::function<void(ConstrainedTriangulation&)>& cut)
{
  ConstrainedTriangulation result;
  const int threads = threadCount(options.Threads);
  Stopwatch watch;
  result.Constraints = resolveCrossings(input, constraints, crossings, threads);
  std::vector<TriangulationStatistics::Phase> phases{ { "crossings", watch.restart() } };

  std::vector<Point2> withCrossings;
  PointsView points = input;
  if (!result.Constraints.Crossings.empty())
  {
    withCrossings = allPoints(input, result.Constraints.Crossings);
    points = PointsView(&withCrossings.front().x, withCrossings.size(), 2);
  }
  PartitionConstraints inserted(points, result.Constraints.Pieces);
  TriangulationOptions own = options;
  own.MaximumEdge = 0; // triangles are left out at the end
  own.MakeEditor = [&inserted](double factor) { return inserted.makeEditor(factor); };
  phases.push_back({ "pieces", watch.restart() });
  result.Mesh = triangulate(points, own);
  auto& all = result.Mesh.Statistics.Phases;
  all.insert(all.begin(), phases.begin(), phases.end());
  if (!result.Mesh.Aborted)
  {
    watch.restart();
    constrain(points, result.Mesh, result.Constraints.Pieces, inserted, threads);
    if (cut)
    {
      cut(result);
    }
    leaveOutLong(points, options.MaximumEdge, result.Mesh);
    all.push_back({ "constraints", watch.seconds() });
  }
  return result;
}

} // namespace tipp
