// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Insertion/TriangulateConstrained.h"

#include "Constraints/Insertion/ConstraintJobs.h"
#include "Constraints/Insertion/CrossedTriangles.h"
#include "Constraints/Insertion/PartitionConstraints.h"
#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Parallel/Stopwatch.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tipp
{

namespace
{

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

/// A tree of these segments. An item's Id is the index of the segment.
SegmentTree treeOf(const std::vector<std::int64_t>& some, PointsView points,
  const std::vector<IdSegment>& segments, int threads)
{
  std::vector<SegmentTree::Item> items(some.size());
  forChunks(std::int64_t(some.size()), SegmentTree::Chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
      {
        const IdSegment& segment = segments[std::size_t(some[i])];
        items[i] = { points[std::size_t(segment.A)], points[std::size_t(segment.B)], some[i] };
      }
    });
  return SegmentTree(std::move(items), threads);
}

/// Finds the triangles that segments cross, except for segments that have been inserted already.
/// Segments and corners use the same vertex ids. `blocks` are ranges of interior triangles of
/// partitions, ascending; `inserted` has their crossings, and `remaining` are its remaining
/// segments. The other triangles are searched.
template <typename Id>
CrossedTriangles findCrossedTriangles(PointsView points, const Id* corners, std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const std::vector<IdSegment>& segments,
  const PartitionConstraints& inserted, const std::vector<std::int64_t>& remaining, int threads)
{
  const SegmentTree tree = treeOf(remaining, points, segments, threads);
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
        return;
      }
      for (auto [triangle, segment] : inserted.crossingsIn(range.Partition))
      {
        triangle += std::int64_t(range.Begin);
        if (triangle < std::int64_t(range.End))
        {
          here.Crossings.push_back({ triangle, segment });
        }
      }
    });
  CrossedTriangles all;
  all.Touches = inserted.touches();
  for (const ScannedTriangles& here : found)
  {
    for (const auto& [triangle, segment] : here.Crossings)
    {
      if (all.Triangles.empty() || all.Triangles.back() != triangle)
      {
        all.Triangles.push_back(triangle);
        all.Starts.push_back(std::int64_t(all.Segments.size()));
      }
      all.Segments.push_back(segment);
    }
    all.Touches.insert(all.Touches.end(), here.Touches.begin(), here.Touches.end());
  }
  all.Starts.push_back(std::int64_t(all.Segments.size()));
  sortUnique(all.Touches);
  return all;
}

/// The constraints that may be edges between crossed triangles: the segments that are not inserted,
/// and edges of crossed interior triangles.
ConstraintEdges edgesNear(const SplitSegments& split, const PartitionConstraints& inserted,
  const std::vector<std::int64_t>& remaining)
{
  std::vector<IdSegment> near;
  for (const std::int64_t segment : remaining)
  {
    near.insert(near.end(), split.begin(std::size_t(segment)), split.end(std::size_t(segment)));
  }
  constexpr std::int64_t unknown = -1; // the constraint does not matter
  for (const auto& [a, b] : inserted.fixedEdges())
  {
    near.push_back({ a, b, unknown });
  }
  return ConstraintEdges(near);
}

/// Replaces the points in `segments` and `inserted` by their representatives.
void nameRepresentatives(const std::vector<Duplicate>& duplicates, std::vector<IdSegment>& segments,
  PartitionConstraints& inserted, int threads)
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
    forChunks(std::int64_t(segments.size()), chunk, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        std::for_each(segments.begin() + begin, segments.begin() + end,
          [&](IdSegment& segment)
          {
            segment.A = representative(segment.A);
            segment.B = representative(segment.B);
          });
      });
    inserted.rename(representative);
  }
}

/// Turns a triangulation of points into the constrained Delaunay triangulation with these segments,
/// in place. `inserted`: the segments that are edges of the triangulation already. No two segments
/// may cross. Afterwards the segments refer to representatives, and are split at the vertices on
/// them.
///
/// Only triangles that a segment crosses change. Segments that cross a common triangle form one
/// job, with all triangles that they cross; jobs are independent of each other. A job's new
/// triangles replace its old ones, in order, so the result does not depend on the number of
/// threads.
template <typename Id>
void constrain(PointsView points, Buffer<Id>& ids, const std::vector<TriangleBlock>& blocks,
  std::vector<IdSegment>& segments, const PartitionConstraints& inserted, int threads)
{
  const std::vector<std::int64_t> remaining = inserted.remaining();
  const CrossedTriangles crossed = findCrossedTriangles(
    points, ids.data(), ids.size() / 3, blocks, segments, inserted, remaining, threads);
  SplitSegments split = splitSegments(points, segments, crossed.Touches);
  const ConstraintEdges known = edgesNear(split, inserted, remaining);
  retriangulateJobs(points, ids.data(), crossed, split, known, threads);
  segments = std::move(split.Parts);
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

/// Triangulates with constraints that do not cross. Throws CrossingFound if they do. `watch` has
/// measured the time for the crossings.
ConstrainedTriangulation insert(PointsView points, ResolvedConstraints resolved,
  TriangulationOptions options, const CutTriangles& cut, Stopwatch& watch)
{
  const TriangulationStatistics::Phase crossings{ "crossings", watch.restart() };
  const int threads = threadCount(options.Threads);
  // Long triangles are removed at the end.
  const double maximumEdge = std::exchange(options.MaximumEdge, 0);
  ConstrainedTriangulation result;
  result.Constraints = std::move(resolved);
  std::vector<Point2> withCrossings;
  if (!result.Constraints.Crossings.empty())
  {
    withCrossings = allPoints(points, result.Constraints.Crossings);
    points = PointsView(withCrossings);
  }
  std::vector<IdSegment>& segments = result.Constraints.Segments;
  PartitionConstraints inserted(segments, threads);
  options.Editors = &inserted;
  result.Mesh = triangulate(points, options);
  auto& phases = result.Mesh.Statistics.Phases;
  phases.insert(phases.begin(), crossings);
  if (!result.Mesh.Aborted)
  {
    watch.restart();
    nameRepresentatives(result.Mesh.Duplicates, segments, inserted, threads);
    if (!segments.empty() && result.Mesh.triangleCount() > 0)
    {
      const std::vector<TriangleBlock>& blocks = result.Mesh.Blocks;
      result.Mesh.Ids64.empty()
        ? constrain(points, result.Mesh.Ids32, blocks, segments, inserted, threads)
        : constrain(points, result.Mesh.Ids64, blocks, segments, inserted, threads);
    }
    if (cut)
    {
      cut(result, points);
    }
    leaveOutLong(points, maximumEdge, result.Mesh);
    phases.push_back({ "constraints", watch.restart() });
  }
  return result;
}

} // namespace

ConstrainedTriangulation triangulateConstrained(PointsView points,
  const std::vector<Constraint>& constraints, CrossingRule crossings,
  const TriangulationOptions& options, const CutTriangles& cut)
{
  Stopwatch watch;
  TriangulationOptions plain = options;
  double done = 0; // progress must not decrease if the triangulation is repeated
  if (options.Progress)
  {
    plain.Progress = [&](double part) { return options.Progress(done = std::max(done, part)); };
  }
  ResolvedConstraints resolved = takeConstraints(points, constraints, options.Threads);
  try
  {
    // Most constraints do not cross. If they do, the insertion finds it.
    return insert(points, std::move(resolved), plain, cut, watch);
  }
  catch (const CrossingFound&)
  {
    resolved = resolveCrossings(points, constraints, crossings, options.Threads);
  }
  return insert(points, std::move(resolved), plain, cut, watch);
}

} // namespace tipp
