// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintJobs.h"

#include "Constraints/ConstraintRegion.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

/// Concatenated lists of numbers.
struct Lists
{
  std::vector<std::int64_t> Starts; ///< start of each list, and the end of the last
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

/// For each list, the ascending indices i for which names[i] is the list's index. Negative names
/// are in no list.
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

/// Disjoint sets of pieces (union-find).
class PieceSets
{
public:
  explicit PieceSets(std::size_t pieces)
    : Parents(pieces)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), std::int64_t(0));
  }

  /// The lowest piece in the set of a piece, which represents the set.
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

/// Jobs: groups of triangles and pieces that are retriangulated together.
struct Jobs
{
  std::size_t Count = 0;
  std::vector<std::int64_t> OfPiece; ///< -1 if the piece crosses no triangle
  std::vector<std::int64_t> OfTriangle;
};

/// Jobs are in the order of their first triangles, so that a job's memory is near the last one's.
Jobs makeJobs(const CrossedTriangles& crossed, std::size_t pieces)
{
  PieceSets sets(pieces);
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    const std::int64_t first = crossed.Pieces[std::size_t(crossed.Starts[t])];
    for (std::int64_t i = crossed.Starts[t] + 1; i < crossed.Starts[t + 1]; ++i)
    {
      sets.join(first, crossed.Pieces[std::size_t(i)]);
    }
  }
  Jobs jobs;
  constexpr std::int64_t none = -1;
  jobs.OfPiece.assign(pieces, none);
  jobs.OfTriangle.resize(crossed.Triangles.size());
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    const std::int64_t begin = crossed.Starts[t];
    const auto set = std::size_t(sets.find(crossed.Pieces[std::size_t(begin)]));
    std::int64_t& job = jobs.OfPiece[set];
    job = job == none ? std::int64_t(jobs.Count++) : job;
    jobs.OfTriangle[t] = job;
    for (std::int64_t i = begin; i < crossed.Starts[t + 1]; ++i)
    {
      jobs.OfPiece[std::size_t(crossed.Pieces[std::size_t(i)])] = job;
    }
  }
  return jobs;
}

/// The triangles and pieces of each job.
struct JobLists
{
  explicit JobLists(const Jobs& jobs)
    : Triangles(listsOf(jobs.OfTriangle, jobs.Count))
    , Pieces(listsOf(jobs.OfPiece, jobs.Count))
  {
  }

  Lists Triangles; ///< indices in CrossedTriangles::Triangles
  Lists Pieces;
};

/// A thread's workspace for retriangulation.
template <typename Id>
class JobWorker
{
public:
  using Corners = std::array<PointId, 3>;

  /// `known` are constraints that may already be edges between triangles of a job.
  JobWorker(PointsView points, Id* triangles, const CrossedTriangles& crossed, const JobLists& jobs,
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

  /// The most frequent job: one segment replaces the common edge of two triangles.
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
    if (this->Known.contains(left, right))
    {
      throw CrossingFound();
    }
    const auto [low, high] =
      std::minmax({ fromLowest({ a, right, b }), fromLowest({ a, b, left }) });
    this->store(both[0], low);
    this->store(both[1], high);
  }

  PointsView Points;
  Id* Triangles;
  const CrossedTriangles& Crossed;
  const JobLists& All;
  const SplitPieces& Split;
  const ConstraintEdges& Known;
  ConstraintRegion Region;
  std::vector<Corners> New;
};

} // namespace

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
  split.Parts.reserve(pieces.size() + touches.size());
  split.Starts.reserve(pieces.size() + 1);
  auto touch = touches.begin();
  std::vector<PointId> vertices;
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    const ConstraintPiece& piece = pieces[p];
    vertices.clear();
    for (; touch != touches.end() && touch->Piece == std::int64_t(p); ++touch)
    {
      vertices.push_back(touch->Vertex);
    }
    if (!vertices.empty()) // seldom; positions are anywhere in memory
    {
      const bool isAscending = lexicographicLess(at(piece.A), at(piece.B));
      std::sort(vertices.begin(), vertices.end(),
        [&](PointId a, PointId b) {
          return isAscending ? lexicographicLess(at(a), at(b)) : lexicographicLess(at(b), at(a));
        });
    }
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

std::vector<std::int64_t> jobsOfTriangles(const CrossedTriangles& crossed, std::size_t pieces)
{
  return makeJobs(crossed, pieces).OfTriangle;
}

template <typename Id>
void retriangulateJobs(PointsView points, Id* triangles, const CrossedTriangles& crossed,
  std::size_t pieces, const SplitPieces& split, const ConstraintEdges& known, int threads)
{
  const Jobs jobs = makeJobs(crossed, pieces);
  const JobLists lists(jobs);
  std::vector<JobWorker<Id>> workers(
    std::size_t(threads), JobWorker<Id>(points, triangles, crossed, lists, split, known));
  constexpr std::int64_t chunk = 256;
  forChunks(std::int64_t(jobs.Count), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t job = begin; job < end; ++job)
      {
        workers[std::size_t(thread)].run(std::size_t(job));
      }
    });
}

template void retriangulateJobs(PointsView, std::int32_t*, const CrossedTriangles&, std::size_t,
  const SplitPieces&, const ConstraintEdges&, int);
template void retriangulateJobs(PointsView, std::int64_t*, const CrossedTriangles&, std::size_t,
  const SplitPieces&, const ConstraintEdges&, int);

} // namespace tipp
