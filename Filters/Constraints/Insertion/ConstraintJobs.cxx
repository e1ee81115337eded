// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/ConstraintJobs.h"

#include "Arrays/IndexMap.h"
#include "Constraints/Insertion/ConstraintRegion.h"
#include "Constraints/Insertion/TriangleStrip.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <array>
#include <deque>
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
  std::vector<std::int64_t> OfTriangle;
  std::vector<std::int64_t> Pieces;  ///< that cross triangles, each once
  std::vector<std::int64_t> OfPiece; ///< by index in Pieces
};

/// Jobs are in the order of their first triangles, so that a job's memory is near that of the one
/// before.
Jobs makeJobs(const CrossedTriangles& crossed)
{
  Jobs jobs;
  IndexMap numbers;                 // only a few of all pieces are left
  std::vector<std::int64_t> pieces; // as crossed.Pieces, but indices in jobs.Pieces
  pieces.reserve(crossed.Pieces.size());
  for (const std::int64_t piece : crossed.Pieces)
  {
    const auto [number, isNew] = numbers.insert(piece);
    isNew ? jobs.Pieces.push_back(piece) : void();
    pieces.push_back(number);
  }
  PieceSets sets(jobs.Pieces.size());
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    const std::int64_t first = pieces[std::size_t(crossed.Starts[t])];
    for (std::int64_t i = crossed.Starts[t] + 1; i < crossed.Starts[t + 1]; ++i)
    {
      sets.join(first, pieces[std::size_t(i)]);
    }
  }
  constexpr std::int64_t none = -1;
  jobs.OfPiece.assign(jobs.Pieces.size(), none);
  jobs.OfTriangle.resize(crossed.Triangles.size());
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    const std::int64_t begin = crossed.Starts[t];
    std::int64_t& job = jobs.OfPiece[std::size_t(sets.find(pieces[std::size_t(begin)]))];
    job = job == none ? std::int64_t(jobs.Count++) : job;
    jobs.OfTriangle[t] = job;
    for (std::int64_t i = begin; i < crossed.Starts[t + 1]; ++i)
    {
      jobs.OfPiece[std::size_t(pieces[std::size_t(i)])] = job;
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
  Lists Pieces;    ///< indices in Jobs::Pieces
};

/// A thread's workspace for retriangulation.
template <typename Id>
class JobWorker
{
public:
  using Corners = std::array<PointId, 3>;

  /// `known` are constraints that may already be edges between triangles of a job.
  JobWorker(PointsView points, Id* triangles, const CrossedTriangles& crossed, const Jobs& jobs,
    const JobLists& lists, const SplitPieces& split, const ConstraintEdges& known)
    : Points(points)
    , Triangles(triangles)
    , Crossed(crossed)
    , Pieces(jobs.Pieces)
    , All(lists)
    , Split(split)
    , Known(known)
  {
  }

  /// Runs the jobs [begin, end).
  void run(std::size_t begin, std::size_t end)
  {
    this->load(begin, end);
    for (std::size_t job = begin; job < end; ++job)
    {
      this->retriangulate(job);
    }
  }

private:
  /// Copies the triangles of all jobs first. They and their points are scattered in memory, and
  /// independent loads overlap.
  void load(std::size_t begin, std::size_t end)
  {
    const std::int64_t* const first = this->All.Triangles.begin(begin);
    const auto count = std::size_t(this->All.Triangles.end(end - 1) - first);
    this->Loaded.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const Id* const ids = this->corners(first[i]);
      this->Loaded[i].Ids = { ids[0], ids[1], ids[2] };
    }
    for (LocatedTriangle& triangle : this->Loaded)
    {
      std::transform(triangle.Ids.begin(), triangle.Ids.end(), triangle.Positions.begin(),
        [this](PointId id) { return this->Points[std::size_t(id)]; });
    }
    this->LoadedBegin = first;
  }

  void retriangulate(std::size_t job)
  {
    this->New.clear();
    const ConstraintPiece* const only = this->onlySegment(job);
    only ? this->retriangulateStrip(job, *only) : this->retriangulateRegion(job);
    std::sort(this->New.begin(), this->New.end());
    for (std::size_t i = 0; i < this->New.size(); ++i)
    {
      this->store(this->All.Triangles.begin(job)[i], this->New[i]);
    }
  }

  /// If the job has only one segment and a few triangles, as most jobs do: this segment. Otherwise
  /// null.
  const ConstraintPiece* onlySegment(std::size_t job) const
  {
    if (this->All.Pieces.size(job) != 1 ||
      this->All.Triangles.size(job) > TriangleStrip::MostTriangles)
    {
      return nullptr;
    }
    const std::size_t piece = this->piece(*this->All.Pieces.begin(job));
    return this->Split.end(piece) - this->Split.begin(piece) == 1 ? this->Split.begin(piece)
                                                                  : nullptr;
  }

  void retriangulateStrip(std::size_t job, const ConstraintPiece& segment)
  {
    this->Strip.follow(
      this->loaded(job), this->All.Triangles.size(job), segment.A, segment.B, this->isKnown());
    this->Strip.triangulate([this](const Corners& corners) { this->addNew(corners); });
  }

  void retriangulateRegion(std::size_t job)
  {
    this->Region.clear();
    std::for_each(this->loaded(job), this->loaded(job) + this->All.Triangles.size(job),
      [this](const LocatedTriangle& triangle)
      { this->Region.add(triangle.Ids, triangle.Positions); });
    this->Region.finish();
    this->Region.fixEdges(this->isKnown());
    for (auto i = this->All.Pieces.begin(job); i != this->All.Pieces.end(job); ++i)
    {
      std::for_each(this->Split.begin(this->piece(*i)), this->Split.end(this->piece(*i)),
        [this](const ConstraintPiece& part) { this->Region.insert(part.A, part.B); });
    }
    for (std::size_t t = 0; t < this->Region.triangleCount(); ++t)
    {
      this->addNew(this->Region.triangle(t));
    }
  }

  void addNew(const Corners& corners)
  {
    this->New.push_back(TriangleSink<PointId>::fromLowest(corners));
  }

  std::size_t piece(std::int64_t number) const
  {
    return std::size_t(this->Pieces[std::size_t(number)]);
  }

  auto isKnown() const
  {
    return [this](PointId a, PointId b) { return this->Known.contains(a, b); };
  }

  const LocatedTriangle* loaded(std::size_t job) const
  {
    return &this->Loaded[std::size_t(this->All.Triangles.begin(job) - this->LoadedBegin)];
  }

  Id* corners(std::int64_t crossed) const
  {
    return this->Triangles + 3 * this->Crossed.Triangles[std::size_t(crossed)];
  }

  void store(std::int64_t crossed, const Corners& ids) const
  {
    std::transform(
      ids.begin(), ids.end(), this->corners(crossed), [](PointId id) { return Id(id); });
  }

  PointsView Points;
  Id* Triangles;
  const CrossedTriangles& Crossed;
  const std::vector<std::int64_t>& Pieces;
  const JobLists& All;
  const SplitPieces& Split;
  const ConstraintEdges& Known;
  std::vector<LocatedTriangle> Loaded;       ///< of several jobs
  const std::int64_t* LoadedBegin = nullptr; ///< the entry of All.Triangles for the first one
  TriangleStrip Strip;
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

std::vector<std::int64_t> jobsOfTriangles(const CrossedTriangles& crossed)
{
  return makeJobs(crossed).OfTriangle;
}

template <typename Id>
void retriangulateJobs(PointsView points, Id* triangles, const CrossedTriangles& crossed,
  const SplitPieces& split, const ConstraintEdges& known, int threads)
{
  const Jobs jobs = makeJobs(crossed);
  const JobLists lists(jobs);
  std::deque<JobWorker<Id>> workers;
  for (int thread = 0; thread < threads; ++thread)
  {
    workers.emplace_back(points, triangles, crossed, jobs, lists, split, known);
  }
  constexpr std::int64_t chunk = 256;
  forChunks(std::int64_t(jobs.Count), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    { workers[std::size_t(thread)].run(std::size_t(begin), std::size_t(end)); });
}

template void retriangulateJobs(PointsView, std::int32_t*, const CrossedTriangles&,
  const SplitPieces&, const ConstraintEdges&, int);
template void retriangulateJobs(PointsView, std::int64_t*, const CrossedTriangles&,
  const SplitPieces&, const ConstraintEdges&, int);

} // namespace tipp
