// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/TriangulateConstrained.h"

#include "Arrays/SortUnique.h"
#include "Constraints/Insertion/ConstraintJobs.h"
#include "Constraints/Insertion/PartitionConstraints.h"
#include "Constraints/Insertion/TriangleScan.h"
#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace tipp
{
namespace
{

constexpr PartitionIndex NoPartition = -1;

/// The blocks, and small ranges of the triangles between them, which have NoPartition.
std::vector<TriangleBlock> withGaps(const std::vector<TriangleBlock>& blocks, std::size_t triangles)
{
  constexpr std::size_t most = TriangleScan<std::int32_t>::MostTriangles;
  std::vector<TriangleBlock> all;
  std::size_t done = 0;
  const auto fillUntil = [&](std::size_t end)
  {
    for (; done < end; done = all.back().End)
    {
      all.push_back({ NoPartition, done, std::min(done + most, end) });
    }
  };
  for (const TriangleBlock& block : blocks)
  {
    fillUntil(block.Begin);
    all.push_back(block);
    done = block.End;
  }
  fillUntil(triangles);
  return all;
}

/// A tree of these pieces. An item's Id is the index of the piece.
SegmentTree treeOf(const std::vector<std::int64_t>& some, PointsView points,
  const std::vector<ConstraintPiece>& pieces, int threads)
{
  std::vector<SegmentTree::Item> items(some.size());
  forChunks(std::int64_t(some.size()), SegmentTree::Chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
      {
        const ConstraintPiece& piece = pieces[std::size_t(some[i])];
        items[i] = { points[std::size_t(piece.A)], points[std::size_t(piece.B)], some[i] };
      }
    });
  return SegmentTree(std::move(items), threads);
}

/// Finds the triangles that pieces cross, except for pieces that have been inserted already. Pieces
/// and corners use the same vertex ids. `blocks` are ranges of interior triangles of partitions,
/// ascending; `inserted` has their crossings, and `remaining` are its remaining pieces. The other
/// triangles are searched.
template <typename Id>
CrossedTriangles findCrossedTriangles(PointsView points, const Id* corners, std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, const std::vector<std::int64_t>& remaining, int threads)
{
  const SegmentTree tree = treeOf(remaining, points, pieces, threads);
  const std::vector<TriangleBlock> ranges = withGaps(blocks, triangles);
  std::vector<TriangleScan<Id>> scans(std::size_t(threads), TriangleScan<Id>(points, tree));
  std::vector<ScannedTriangles> found(ranges.size());
  forChunks(std::int64_t(ranges.size()), 1, threads, {},
    [&](std::int64_t i, std::int64_t, int thread)
    {
      const TriangleBlock& range = ranges[std::size_t(i)];
      ScannedTriangles& here = found[std::size_t(i)];
      if (range.Partition == NoPartition)
      {
        scans[std::size_t(thread)].scan(corners, range.Begin, range.End, here);
        std::sort(here.Crossings.begin(), here.Crossings.end());
      }
    });
  CrossedTriangles all;
  all.Touches = inserted.touches();
  const auto add = [&all](std::int64_t triangle, std::int64_t piece)
  {
    if (all.Triangles.empty() || all.Triangles.back() != triangle)
    {
      all.Triangles.push_back(triangle);
      all.Starts.push_back(std::int64_t(all.Pieces.size()));
    }
    all.Pieces.push_back(piece);
  };
  for (std::size_t i = 0; i < ranges.size(); ++i)
  {
    const auto& [partition, begin, end] = ranges[i];
    if (partition != NoPartition)
    {
      for (const auto& [triangle, piece] : inserted.crossingsIn(partition))
      {
        const std::int64_t number = std::int64_t(begin) + triangle;
        number < std::int64_t(end) ? add(number, piece) : void();
      }
    }
    for (const CrossedTriangles::Crossing& crossing : found[i].Crossings)
    {
      add(crossing.Triangle, crossing.Piece);
    }
    all.Touches.insert(all.Touches.end(), found[i].Touches.begin(), found[i].Touches.end());
  }
  all.Starts.push_back(std::int64_t(all.Pieces.size()));
  sortUnique(all.Touches);
  return all;
}

/// The constraints that may be edges between crossed triangles: the pieces that are not inserted,
/// and edges of crossed interior triangles.
ConstraintEdges edgesNear(const SplitPieces& split, const PartitionConstraints& inserted,
  const std::vector<std::int64_t>& remaining)
{
  std::vector<ConstraintPiece> near;
  for (const std::int64_t piece : remaining)
  {
    near.insert(near.end(), split.begin(std::size_t(piece)), split.end(std::size_t(piece)));
  }
  constexpr std::int64_t unknown = -1; // the constraint does not matter
  for (const auto& [a, b] : inserted.fixedEdges())
  {
    near.push_back({ a, b, unknown });
  }
  return ConstraintEdges(near);
}

template <typename Id>
void constrainTriangles(PointsView points, Buffer<Id>& ids,
  const std::vector<TriangleBlock>& blocks, std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, int threads)
{
  const std::vector<std::int64_t> remaining = inserted.remaining();
  const CrossedTriangles crossed = findCrossedTriangles(
    points, ids.data(), ids.size() / 3, blocks, pieces, inserted, remaining, threads);
  SplitPieces split = splitPieces(points, pieces, crossed.Touches);
  const ConstraintEdges known = edgesNear(split, inserted, remaining);
  retriangulateJobs(points, ids.data(), crossed, split, known, threads);
  pieces = std::move(split.Parts);
}

/// Replaces the points in `pieces` and `inserted` by their representatives.
void nameRepresentatives(const std::vector<Duplicate>& duplicates,
  std::vector<ConstraintPiece>& pieces, PartitionConstraints& inserted, int threads)
{
  const auto representative = [&](PointId id)
  {
    const auto found = std::lower_bound(duplicates.begin(), duplicates.end(), id,
      [](const Duplicate& duplicate, PointId wanted) { return duplicate.Point < wanted; });
    return found != duplicates.end() && found->Point == id ? found->Representative : id;
  };
  if (!duplicates.empty())
  {
    constexpr std::int64_t chunk = 65536;
    forChunks(std::int64_t(pieces.size()), chunk, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        std::for_each(pieces.begin() + begin, pieces.begin() + end,
          [&](ConstraintPiece& piece)
          {
            piece.A = representative(piece.A);
            piece.B = representative(piece.B);
          });
      });
    inserted.rename(representative);
  }
}

/// Turns a triangulation of points into the constrained Delaunay triangulation with these pieces,
/// in place. `inserted` has pieces that were inserted during the triangulation. No piece crosses
/// another. Afterwards the pieces refer to representatives, and are split at the vertices on them.
///
/// Only triangles that a piece crosses change. Pieces that cross a common triangle form one job,
/// with all triangles that they cross; jobs are independent of each other. A job's new triangles
/// replace its old ones, in order, so the result does not depend on the number of threads.
void constrain(PointsView points, Triangulation& triangulation,
  std::vector<ConstraintPiece>& pieces, PartitionConstraints& inserted, int threads)
{
  nameRepresentatives(triangulation.Duplicates, pieces, inserted, threads);
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

/// The points of the input, followed by the crossings.
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

/// Triangulates with constraints that do not cross. Throws CrossingFound if they do.
class Run
{
public:
  Run(PointsView input, const TriangulationOptions& options,
    const std::function<void(ConstrainedTriangulation&)>& cut)
    : Input(input)
    , Options(options)
    , Cut(cut)
    , Threads(threadCount(options.Threads))
  {
    this->Plain = options;
    this->Plain.MaximumEdge = 0; // long triangles are removed at the end
    if (options.Progress)
    {
      // Progress must not decrease if the triangulation is repeated.
      this->Plain.Progress = [this](double done)
      { return this->Options.Progress(this->Done = std::max(this->Done, done)); };
    }
  }

  ConstrainedTriangulation run(const std::vector<Constraint>& constraints, CrossingRule crossings)
  {
    this->Watch.restart();
    ResolvedConstraints resolved = takeConstraints(this->Input, constraints, this->Threads);
    try
    {
      // Most constraints do not cross. If they do, the insertion finds it.
      return this->insert(std::move(resolved));
    }
    catch (const CrossingFound&)
    {
      resolved = resolveCrossings(this->Input, constraints, crossings, this->Threads);
    }
    return this->insert(std::move(resolved));
  }

private:
  ConstrainedTriangulation insert(ResolvedConstraints resolved)
  {
    ConstrainedTriangulation result;
    result.Constraints = std::move(resolved);
    const TriangulationStatistics::Phase crossings{ "crossings", this->Watch.restart() };
    std::vector<Point2> withCrossings;
    PointsView points = this->Input;
    if (!result.Constraints.Crossings.empty())
    {
      withCrossings = allPoints(this->Input, result.Constraints.Crossings);
      points = PointsView(withCrossings);
    }
    PartitionConstraints inserted(result.Constraints.Pieces, this->Threads);
    this->Plain.Editors = &inserted;
    result.Mesh = triangulate(points, this->Plain);
    auto& all = result.Mesh.Statistics.Phases;
    all.insert(all.begin(), crossings);
    if (!result.Mesh.Aborted)
    {
      this->Watch.restart();
      constrain(points, result.Mesh, result.Constraints.Pieces, inserted, this->Threads);
      if (this->Cut)
      {
        this->Cut(result);
      }
      leaveOutLong(points, this->Options.MaximumEdge, result.Mesh);
      all.push_back({ "constraints", this->Watch.restart() });
    }
    return result;
  }

  const PointsView Input;
  const TriangulationOptions& Options;
  const std::function<void(ConstrainedTriangulation&)>& Cut;
  const int Threads;
  TriangulationOptions Plain;
  double Done = 0; ///< the last reported fraction
  Stopwatch Watch;
};

} // namespace

ConstrainedTriangulation triangulateConstrained(PointsView input,
  const std::vector<Constraint>& constraints, CrossingRule crossings,
  const TriangulationOptions& options, const std::function<void(ConstrainedTriangulation&)>& cut)
{
  return Run(input, options, cut).run(constraints, crossings);
}

} // namespace tipp
