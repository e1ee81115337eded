// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/TriangulateConstrained.h"

#include "Constraints/ConstraintPoints.h"
#include "Constraints/Insertion/ConstraintJobs.h"
#include "Constraints/Insertion/CrossedTriangles.h"
#include "Constraints/Insertion/PartitionConstraints.h"
#include "Constraints/KeepInside.h"
#include "Constraints/SegmentTree.h"
#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Parallel/Stopwatch.h"
#include "Points/Longitudes.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>
#include <stdexcept>
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
        return;
      }
      for (auto [triangle, piece] : inserted.crossingsIn(range.Partition))
      {
        triangle += std::int64_t(range.Begin);
        if (triangle < std::int64_t(range.End))
        {
          here.Crossings.push_back({ triangle, piece });
        }
      }
    });
  CrossedTriangles all;
  all.Touches = inserted.touches();
  for (const ScannedTriangles& here : found)
  {
    for (const auto& [triangle, piece] : here.Crossings)
    {
      if (all.Triangles.empty() || all.Triangles.back() != triangle)
      {
        all.Triangles.push_back(triangle);
        all.Starts.push_back(std::int64_t(all.Pieces.size()));
      }
      all.Pieces.push_back(piece);
    }
    all.Touches.insert(all.Touches.end(), here.Touches.begin(), here.Touches.end());
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
template <typename Id>
void constrain(PointsView points, Buffer<Id>& ids, const std::vector<TriangleBlock>& blocks,
  std::vector<ConstraintPiece>& pieces, const PartitionConstraints& inserted, int threads)
{
  const std::vector<std::int64_t> remaining = inserted.remaining();
  const CrossedTriangles crossed = findCrossedTriangles(
    points, ids.data(), ids.size() / 3, blocks, pieces, inserted, remaining, threads);
  SplitPieces split = splitPieces(points, pieces, crossed.Touches);
  const ConstraintEdges known = edgesNear(split, inserted, remaining);
  retriangulateJobs(points, ids.data(), crossed, split, known, threads);
  pieces = std::move(split.Parts);
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
  TriangulationOptions options, const std::function<void(ConstrainedTriangulation&)>& cut,
  Stopwatch& watch)
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
  std::vector<ConstraintPiece>& pieces = result.Constraints.Pieces;
  PartitionConstraints inserted(pieces, threads);
  options.Editors = &inserted;
  result.Mesh = triangulate(points, options);
  auto& phases = result.Mesh.Statistics.Phases;
  phases.insert(phases.begin(), crossings);
  if (!result.Mesh.Aborted)
  {
    watch.restart();
    nameRepresentatives(result.Mesh.Duplicates, pieces, inserted, threads);
    if (!pieces.empty() && result.Mesh.triangleCount() > 0)
    {
      const std::vector<TriangleBlock>& blocks = result.Mesh.Blocks;
      result.Mesh.Ids64.empty()
        ? constrain(points, result.Mesh.Ids32, blocks, pieces, inserted, threads)
        : constrain(points, result.Mesh.Ids64, blocks, pieces, inserted, threads);
    }
    if (cut)
    {
      cut(result);
    }
    leaveOutLong(points, maximumEdge, result.Mesh);
    phases.push_back({ "constraints", watch.restart() });
  }
  return result;
}

PointsView viewOf(const std::vector<double>& xy)
{
  return PointsView(xy.data(), xy.size() / 2, 2);
}

/// Appends the table's points, except those that exist already, and its edges.
void join(const ConstraintTable& table, PointTable& points, std::vector<Constraint>& constraints)
{
  if (table.XY.empty()) // its edges refer to the points
  {
    for (const auto& edge : table.Edges)
    {
      constraints.push_back({ edge[0], edge[1] });
    }
    return;
  }
  const MatchedPositions matched = matchPositions(viewOf(points.XY), viewOf(table.XY));
  for (const std::size_t own : matched.New)
  {
    points.XY.push_back(table.XY[2 * own]);
    points.XY.push_back(table.XY[2 * own + 1]);
    for (PointTable::Column& column : points.Columns)
    {
      column.Values.push_back(
        isHeightColumn(column.Name) && !table.Height.empty() ? table.Height[own] : std::nan(""));
    }
  }
  for (const auto& edge : table.Edges)
  {
    constraints.push_back({ matched.Ids[std::size_t(edge[0])], matched.Ids[std::size_t(edge[1])] });
  }
}

/// Sets the NaN values of points from index `given` on, by interpolation on the surface of the
/// points before.
void takeSurface(
  std::size_t given, DuplicateRule rule, const TriangulationOptions& options, PointTable& points)
{
  const auto isMissing = [given](const PointTable::Column& column)
  {
    return std::any_of(column.Values.begin() + std::ptrdiff_t(given), column.Values.end(),
      [](double value) { return std::isnan(value); });
  };
  if (std::none_of(points.Columns.begin(), points.Columns.end(), isMissing))
  {
    return;
  }
  TriangulationOptions plain;
  plain.Threads = options.Threads;
  const PointsView before(points.XY.data(), given, 2);
  const Triangulation surface = triangulate(before, plain);
  PointTable resolved;
  if (rule != DuplicateRule::First)
  {
    resolved.Columns = points.Columns;
    resolveDuplicates(resolved, surface.Duplicates, rule);
  }
  std::vector<const double*> columns;
  for (const PointTable::Column& column :
    rule == DuplicateRule::First ? points.Columns : resolved.Columns)
  {
    columns.push_back(column.Values.data());
  }
  std::vector<Point2> positions;
  viewOf(points.XY).forEach(
    given, points.size(), [&](std::size_t, Point2 position) { positions.push_back(position); });
  const auto values = valuesOnSurface(positions, before, surface, columns, options.Threads);
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      double& value = points.Columns[c].Values[given + i];
      value = std::isnan(value) ? values[c][i] : value;
    }
  }
}

void appendCrossings(const std::vector<CrossingPoint>& crossings, PointTable& points)
{
  const std::size_t given = points.size();
  for (const CrossingPoint& crossing : crossings)
  {
    points.XY.push_back(crossing.Position.x);
    points.XY.push_back(crossing.Position.y);
  }
  for (PointTable::Column& column : points.Columns)
  {
    column.Values.resize(given + crossings.size());
    interpolateTuples(crossings, given, Scalar::Float64, 1, column.Values.data());
  }
}

void cutOutside(
  const TableConstraints& constraints, const PointTable& points, ConstrainedTriangulation& result)
{
  const std::vector<ConstraintPiece>& pieces = result.Constraints.Pieces;
  const std::size_t lines = constraints.Lines.Edges.size();
  const Cuts cuts{ piecesOf(pieces, constraints.Lines.PolygonBegin, lines),
    piecesOf(pieces, lines, lines + constraints.Boundary.Edges.size()), constraints.Lines.holes() };
  // A polygon with a missing edge has no inside, nor has one without any edge left.
  const bool hasPolygons =
    constraints.Lines.PolygonBegin < lines || !constraints.Boundary.Edges.empty();
  if (hasPolygons && result.Constraints.NotFinite > 0)
  {
    throw std::invalid_argument(
      "it has polygons, and a point that is NaN or infinite; correct the point.");
  }
  keepInside(viewOf(points.XY), result.Mesh, pieces, cuts);
}

} // namespace

ConstrainedTriangulation triangulateConstrained(PointsView points,
  const std::vector<Constraint>& constraints, CrossingRule crossings,
  const TriangulationOptions& options, const std::function<void(ConstrainedTriangulation&)>& cut)
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

bool isHeightColumn(const std::string& name)
{
  return name == "z" || name == "Z" || name == "elevation";
}

ConstrainedTriangulation triangulateTable(
  PointTable& points, const TableConstraints& constraints, const TriangulationOptions& options)
{
  const std::size_t given = points.size();
  std::vector<Constraint> all;
  join(constraints.Lines, points, all);
  join(constraints.Boundary, points, all);
  if (constraints.Surface)
  {
    takeSurface(given, *constraints.Surface, options, points);
  }
  const auto cut = [&](ConstrainedTriangulation& whole)
  {
    appendCrossings(whole.Constraints.Crossings, points);
    cutOutside(constraints, points, whole);
  };
  return triangulateConstrained(viewOf(points.XY), all, constraints.Crossings, options, cut);
}

TableConstraints readConstraints(const ConstraintFiles& files)
{
  TableConstraints constraints;
  if (!files.Lines.empty())
  {
    constraints.Lines = readConstraintFile(files.Lines, files.Wrap);
  }
  for (const auto& [x, y] : files.Holes)
  {
    constraints.Lines.Holes.insert(constraints.Lines.Holes.end(), { x, y });
  }
  wrapLongitudes(files.name(), files.Wrap, constraints.Lines.Holes);
  if (!files.Boundary.empty())
  {
    constraints.Boundary = readBoundary(files.Boundary, files.Wrap);
  }
  constraints.Crossings = files.Crossings;
  return constraints;
}

ConstraintTable readBoundary(const std::string& path, int wrap)
{
  ConstraintTable boundary = readConstraintFile(path, wrap);
  try
  {
    requireClosedBoundary(boundary);
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(path, error.what());
  }
  return boundary;
}

void requireClosedBoundary(const ConstraintTable& boundary)
{
  if (boundary.Edges.empty() || boundary.XY.empty())
  {
    throw std::invalid_argument(
      "it has no lines with coordinates, so it is no boundary; give closed lines or polygons.");
  }
  std::map<std::pair<double, double>, int> ends; // number of edges; odd ends are open
  for (const auto& edge : boundary.Edges)
  {
    for (const std::int64_t end : edge)
    {
      const auto at = 2 * std::size_t(end);
      ++ends[{ boundary.XY[at], boundary.XY[at + 1] }];
    }
  }
  const auto open =
    std::find_if(ends.begin(), ends.end(), [](const auto& end) { return end.second % 2 != 0; });
  if (open != ends.end())
  {
    std::ostringstream text;
    text << "the boundary is not closed: a line ends at (" << open->first.first << ", "
         << open->first.second << "); close it there.";
    throw std::invalid_argument(text.str());
  }
}

} // namespace tipp
