// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/TriangulatePoints.h"

#include "Arrays/FindNeighbors.h"
#include "Constraints/Insertion/KeepInside.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Statistics/RunStatistics.h"
#include "Triangulation/MergeClose.h"

#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{

namespace
{

template <typename From, typename To>
Buffer<To> renumbered(const Buffer<From>& ids, const Buffer<PointId>& originals)
{
  Buffer<To> result(ids.size());
  const std::int64_t count = std::int64_t(ids.size());
  forIndices(count, [&](std::int64_t i) { result[i] = To(originals[std::size_t(ids[i])]); });
  return result;
}

void renumber(Triangulation& result, const Buffer<PointId>& originals)
{
  if (!result.Ids64.empty())
  {
    result.Ids64 = renumbered<std::int64_t, std::int64_t>(result.Ids64, originals);
  }
  else if (originals[originals.size() - 1] <= std::numeric_limits<std::int32_t>::max())
  {
    result.Ids32 = renumbered<std::int32_t, std::int32_t>(result.Ids32, originals);
  }
  else
  {
    result.Ids64 = renumbered<std::int32_t, std::int64_t>(result.Ids32, originals);
    result.Ids32 = {};
  }
}

/// The ids keep their order, so the tetrahedra do, too.
void renumber(Tetrahedralization& result, const Buffer<PointId>& originals)
{
  result.Ids = renumbered<std::int32_t, std::int32_t>(result.Ids, originals);
}

/// Calls merge(progress), then triangulate(points, options) for the points that are left.
template <typename Options, typename Merge, typename Triangulate>
auto triangulateKept(const Options& options, const Merge& merge, const Triangulate& triangulate)
{
  constexpr double mergingShare = 0.2; // fraction of the reported progress
  Options scaled = options;
  scaled.Progress = partOf(options.Progress, mergingShare, 1);
  const Stopwatch watch;
  MergedPoints merged = merge(partOf(options.Progress, 0, mergingShare));
  decltype(triangulate(merged, scaled)) result;
  if (merged.Aborted)
  {
    result.Aborted = true;
    return result;
  }
  const double mergingSeconds = watch.seconds();
  result = triangulate(merged, scaled);
  if (!merged.Ids.empty())
  {
    renumber(result, merged.Ids);
  }
  auto& phases = result.Statistics.Phases;
  phases.insert(phases.begin(), { "merging", mergingSeconds });
  result.Duplicates = std::move(merged.Duplicates);
  result.Rejected = std::move(merged.Rejected);
  return result;
}

} // namespace

Triangulation triangulateMerged(
  PointsView points, double distance, const TriangulationOptions& options)
{
  const auto positionOf = [points](std::size_t i) { return points[i]; };
  return triangulateKept(
    options,
    [&](const Report& progress)
    { return mergeClose<2>(points.size(), positionOf, distance, progress); },
    [](const MergedPoints& kept, const TriangulationOptions& scaled)
    { return triangulate(PointsView(kept.Coordinates.data(), kept.Ids.size(), 2), scaled); });
}

Tetrahedralization tetrahedralizeMerged(const Point3* points, std::size_t count, double distance,
  const TetrahedralizationOptions& options)
{
  requireShortIds(count);
  const auto positionOf = [points](std::size_t i) { return points[i]; };
  return triangulateKept(
    options,
    [&](const Report& progress) { return mergeClose<3>(count, positionOf, distance, progress); },
    [](const MergedPoints& kept, const TetrahedralizationOptions& scaled)
    { return tetrahedralize(kept.Coordinates.as<Point3>(), kept.Ids.size(), scaled); });
}

void requireIds(const SourceConstraints& constraints, std::int64_t points)
{
  for (std::size_t i = 0; i < constraints.Constraints.size(); ++i)
  {
    for (const PointId id : { constraints.Constraints[i].A, constraints.Constraints[i].B })
    {
      if (id < 0 || id >= points)
      {
        throw std::runtime_error("cell " + std::to_string(constraints.Cells[i]) +
          " of the source names point " + std::to_string(id) + ", but the input has " +
          std::to_string(points) +
          " points: the source's ids are the input's, unless MergeSourcePoints is on.");
      }
    }
  }
}

namespace
{

/// Throws if a polygon of a data set has a rejected corner: without it the inside would be
/// undefined.
void requireClosed(PointsView points, const SourceConstraints& constraints)
{
  for (std::size_t i = constraints.PolygonBegin; i < constraints.Cells.size(); ++i)
  {
    const auto id = std::size_t(constraints.Constraints[i].A);
    if (id < points.size() && !isFinite(points[id]))
    {
      throw std::runtime_error("cell " + std::to_string(constraints.Cells[i]) +
        " of the source, a polygon, has the corner " + std::to_string(id) +
        ", which is NaN or infinite: remove the polygon or correct the point.");
    }
  }
}

void append(std::vector<std::string>& warnings, const std::vector<std::string>& more)
{
  warnings.insert(warnings.end(), more.begin(), more.end());
}

} // namespace

ConstrainedTriangulation triangulatePoints(
  PointsView points, const PointsRequest& request, std::vector<std::string>& warnings)
{
  const TriangulationOptions& options = request.Options;
  const auto warn = [&](const Triangulation& mesh, std::size_t count)
  { append(warnings, warningsOf(mesh, std::int64_t(count), options.MaximumEdge > 0)); };
  ConstrainedTriangulation result;
  if (!request.Source || (request.Source->Constraints.empty() && request.Source->Holes.empty()))
  {
    result.Mesh = request.Distance > 0 ? triangulateMerged(points, request.Distance, options)
                                       : triangulate(points, options);
    if (!result.Mesh.Aborted)
    {
      warn(result.Mesh, points.size());
    }
    return result;
  }
  const SourceConstraints& source = *request.Source;
  requireClosed(points, source);
  const auto cut = [&](ConstrainedTriangulation& whole, PointsView all)
  {
    warn(whole.Mesh, all.size());
    const std::vector<IdSegment>& segments = whole.Constraints.Segments;
    const std::size_t end = source.Constraints.size();
    const std::size_t boundary = end - source.BoundaryEdges;
    // A polygon with a missing edge has no inside, nor has one without any edge left.
    if (source.Cells.empty() && source.PolygonBegin < end && whole.Constraints.NotFinite > 0)
    {
      throw std::invalid_argument(
        "it has polygons, and a point that is NaN or infinite; correct the point.");
    }
    whole.Inverted = keepInside(all, whole.Mesh, segments,
      { segmentsOf(segments, source.PolygonBegin, boundary), segmentsOf(segments, boundary, end),
        source.Holes });
  };
  result = triangulateConstrained(points, source.Constraints, request.Crossings, options, cut);
  if (!result.Mesh.Aborted && result.Constraints.NotFinite > 0)
  {
    warnings.push_back(std::to_string(result.Constraints.NotFinite) +
      " edges of the source have an end that is NaN or infinite and are left out.");
  }
  return result;
}

Tetrahedralization tetrahedralizePoints(const Point3* points, std::size_t count, double distance,
  const TetrahedralizationOptions& options, Triangulation& triangles)
{
  Tetrahedralization mesh = distance > 0 ? tetrahedralizeMerged(points, count, distance, options)
                                         : tetrahedralize(points, count, options);
  if (!mesh.Aborted && mesh.Dimension == 2)
  {
    triangles = triangulateCoplanar(points, count, options, mesh);
    mesh.Aborted = triangles.Aborted;
  }
  return mesh;
}

Buffer<std::int64_t> neighborIds(const Triangulation& triangulation)
{
  const std::size_t triangles = triangulation.triangleCount();
  Buffer<std::int64_t> neighbors(3 * triangles);
  triangulation.Ids64.empty()
    ? findNeighbors(triangulation.Ids32.data(), triangles, neighbors.data())
    : findNeighbors(triangulation.Ids64.data(), triangles, neighbors.data());
  return neighbors;
}

Buffer<std::int64_t> neighborIds(const Tetrahedralization& mesh)
{
  Buffer<std::int64_t> neighbors(mesh.Ids.size());
  findNeighbors<4>(mesh.Ids.data(), mesh.cellCount(), neighbors.data());
  return neighbors;
}

namespace
{

template <typename Id>
Buffer<unsigned char> marksOf(const Buffer<Id>& ids, const ConstraintEdges& edges)
{
  Buffer<unsigned char> marks(ids.size());
  const std::int64_t triangles = std::int64_t(ids.size() / 3);
  forIndices(triangles,
    [&](std::int64_t t)
    {
      const Id* const corners = ids.data() + 3 * t;
      for (int i = 0; i < 3; ++i)
      {
        marks[std::size_t(3 * t + i)] =
          edges.contains(corners[(i + 1) % 3], corners[(i + 2) % 3]) ? 1 : 0;
      }
    });
  return marks;
}

} // namespace

Buffer<unsigned char> constraintMarks(
  const Triangulation& triangulation, const std::vector<IdSegment>& segments)
{
  const ConstraintEdges edges(segments);
  return triangulation.Ids64.empty() ? marksOf(triangulation.Ids32, edges)
                                     : marksOf(triangulation.Ids64, edges);
}

} // namespace tipp
