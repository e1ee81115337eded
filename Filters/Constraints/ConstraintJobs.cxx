// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintJobs.h"

#include "Arrays/IndexMap.h"
#include "Arrays/SortUnique.h"
#include "Constraints/ConstraintRegion.h"
#include "Constraints/TriangleStrip.h"
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

/// The crossed triangles of each job, as ascending indices.
class JobTriangles
{
public:
  /// `jobs`: the job of each crossed triangle.
  explicit JobTriangles(const std::vector<std::int64_t>& jobs)
    : Starts(jobs.empty() ? 1 : std::size_t(*std::max_element(jobs.begin(), jobs.end())) + 2, 0)
    , Items(jobs.size())
  {
    for (const std::int64_t job : jobs)
    {
      ++this->Starts[std::size_t(job) + 1];
    }
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    std::vector<std::int64_t> next = this->Starts;
    for (std::size_t i = 0; i < jobs.size(); ++i)
    {
      this->Items[std::size_t(next[std::size_t(jobs[i])]++)] = std::int64_t(i);
    }
  }

  std::int64_t jobs() const { return std::int64_t(this->Starts.size()) - 1; }
  const std::int64_t* begin(std::size_t job) const
  {
    return this->Items.data() + this->Starts[job];
  }
  const std::int64_t* end(std::size_t job) const { return this->begin(job + 1); }
  std::size_t size(std::size_t job) const { return std::size_t(this->end(job) - this->begin(job)); }

private:
  std::vector<std::int64_t> Starts; ///< start of each job's list, and the end of the last
  std::vector<std::int64_t> Items;
};

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

/// A thread's workspace for retriangulation.
template <typename Id>
class JobWorker
{
public:
  using Corners = std::array<PointId, 3>;

  /// `known` are constraints that may already be edges between triangles of a job.
  JobWorker(PointsView points, Id* triangles, const CrossedTriangles& crossed,
    const JobTriangles& all, const SplitPieces& split, const ConstraintEdges& known)
    : Points(points)
    , Triangles(triangles)
    , Crossed(crossed)
    , All(all)
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
    const std::int64_t* const first = this->All.begin(begin);
    const auto count = std::size_t(this->All.end(end - 1) - first);
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
    this->Pieces.clear();
    std::for_each(this->All.begin(job), this->All.end(job),
      [this](std::int64_t crossed)
      {
        const auto first = this->Crossed.Pieces.begin();
        this->Pieces.insert(this->Pieces.end(), first + this->Crossed.Starts[std::size_t(crossed)],
          first + this->Crossed.Starts[std::size_t(crossed) + 1]);
      });
    sortUnique(this->Pieces);
    const ConstraintPiece* const only = this->onlySegment(job);
    only ? this->retriangulateStrip(job, *only) : this->retriangulateRegion(job);
    std::sort(this->New.begin(), this->New.end());
    for (std::size_t i = 0; i < this->New.size(); ++i)
    {
      this->store(this->All.begin(job)[i], this->New[i]);
    }
  }

  /// If the job has only one segment and a few triangles, as most jobs do: this segment. Otherwise
  /// null.
  const ConstraintPiece* onlySegment(std::size_t job) const
  {
    if (this->Pieces.size() != 1 || this->All.size(job) > TriangleStrip::MostTriangles)
    {
      return nullptr;
    }
    const auto piece = std::size_t(this->Pieces.front());
    return this->Split.end(piece) - this->Split.begin(piece) == 1 ? this->Split.begin(piece)
                                                                  : nullptr;
  }

  void retriangulateStrip(std::size_t job, const ConstraintPiece& segment)
  {
    this->Strip.follow(
      this->loaded(job), this->All.size(job), segment.A, segment.B, this->isKnown());
    this->Strip.triangulate([this](const Corners& corners) { this->addNew(corners); });
  }

  void retriangulateRegion(std::size_t job)
  {
    this->Region.clear();
    std::for_each(this->loaded(job), this->loaded(job) + this->All.size(job),
      [this](const LocatedTriangle& triangle)
      { this->Region.add(triangle.Ids, triangle.Positions); });
    this->Region.finish();
    this->Region.fixEdges(this->isKnown());
    for (const std::int64_t piece : this->Pieces)
    {
      std::for_each(this->Split.begin(std::size_t(piece)), this->Split.end(std::size_t(piece)),
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

  auto isKnown() const
  {
    return [this](PointId a, PointId b) { return this->Known.contains(a, b); };
  }

  const LocatedTriangle* loaded(std::size_t job) const
  {
    return &this->Loaded[std::size_t(this->All.begin(job) - this->LoadedBegin)];
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
  const JobTriangles& All;
  const SplitPieces& Split;
  const ConstraintEdges& Known;
  std::vector<LocatedTriangle> Loaded;       ///< of several jobs
  const std::int64_t* LoadedBegin = nullptr; ///< the entry of All for the first one
  std::vector<std::int64_t> Pieces;          ///< that cross the job's triangles
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
  IndexMap numbers;                 // only a few of all pieces are left
  std::vector<std::int64_t> pieces; // as crossed.Pieces, but numbered from 0
  pieces.reserve(crossed.Pieces.size());
  for (const std::int64_t piece : crossed.Pieces)
  {
    pieces.push_back(numbers.insert(piece).Index);
  }
  PieceSets sets(numbers.size());
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    const std::int64_t first = pieces[std::size_t(crossed.Starts[t])];
    for (std::int64_t i = crossed.Starts[t] + 1; i < crossed.Starts[t + 1]; ++i)
    {
      sets.join(first, pieces[std::size_t(i)]);
    }
  }
  constexpr std::int64_t none = -1;
  std::int64_t count = 0;
  std::vector<std::int64_t> jobOfSet(numbers.size(), none); // by the piece that represents it
  std::vector<std::int64_t> jobs;
  jobs.reserve(crossed.Triangles.size());
  for (std::size_t t = 0; t < crossed.Triangles.size(); ++t)
  {
    const std::int64_t set = sets.find(pieces[std::size_t(crossed.Starts[t])]);
    std::int64_t& job = jobOfSet[std::size_t(set)];
    job = job == none ? count++ : job;
    jobs.push_back(job);
  }
  return jobs;
}

template <typename Id>
void retriangulateJobs(PointsView points, Id* triangles, const CrossedTriangles& crossed,
  const SplitPieces& split, const ConstraintEdges& known, int threads)
{
  const JobTriangles jobs(jobsOfTriangles(crossed));
  std::deque<JobWorker<Id>> workers;
  for (int thread = 0; thread < threads; ++thread)
  {
    workers.emplace_back(points, triangles, crossed, jobs, split, known);
  }
  constexpr std::int64_t chunk = 256;
  forChunks(jobs.jobs(), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    { workers[std::size_t(thread)].run(std::size_t(begin), std::size_t(end)); });
}

template void retriangulateJobs(PointsView, std::int32_t*, const CrossedTriangles&,
  const SplitPieces&, const ConstraintEdges&, int);
template void retriangulateJobs(PointsView, std::int64_t*, const CrossedTriangles&,
  const SplitPieces&, const ConstraintEdges&, int);

} // namespace tipp
