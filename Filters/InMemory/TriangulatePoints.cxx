// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/TriangulatePoints.h"

#include "Constraints/KeepInside.h"
#include "InMemory/TriangulateMerged.h"
#include "Meshes/MeshFiles.h"
#include "Output/RunStatistics.h"

#include <stdexcept>

namespace tipp
{

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

/// Throws if a polygon has a rejected corner: without it the inside would be undefined.
void requireClosed(PointsView points, const SourceConstraints& constraints)
{
  for (std::size_t i = constraints.PolygonBegin; i < constraints.Constraints.size(); ++i)
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
  if (!request.Source || request.Source->Constraints.empty())
  {
    result.Mesh = request.Distance > 0 ? triangulateMerged(points, request.Distance, options)
                                       : triangulate(points, options);
    result.Mesh.Aborted ? void() : warn(result.Mesh, points.size());
    return result;
  }
  const SourceConstraints& source = *request.Source;
  requireClosed(points, source);
  const auto cut = [&](ConstrainedTriangulation& whole)
  {
    warn(whole.Mesh, points.size() + whole.Constraints.Crossings.size());
    const std::vector<ConstraintPiece>& pieces = whole.Constraints.Pieces;
    keepInside({}, whole.Mesh, pieces,
      { piecesOf(pieces, source.PolygonBegin, source.Constraints.size()), {}, {} });
  };
  result = triangulateConstrained(points, source.Constraints, request.Crossings, options, cut);
  if (!result.Mesh.Aborted && result.Constraints.NotFinite > 0)
  {
    warnings.push_back(std::to_string(result.Constraints.NotFinite) +
      " edges of the source have an end that is NaN or infinite and are left out.");
  }
  return result;
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
#pragma omp parallel for
  for (std::int64_t t = 0; t < triangles; ++t)
  {
    const Id* const corners = ids.data() + 3 * t;
    for (int i = 0; i < 3; ++i)
    {
      marks[std::size_t(3 * t + i)] =
        edges.contains(corners[(i + 1) % 3], corners[(i + 2) % 3]) ? 1 : 0;
    }
  }
  return marks;
}

} // namespace

Buffer<unsigned char> constraintMarks(
  const Triangulation& triangulation, const std::vector<ConstraintPiece>& pieces)
{
  const ConstraintEdges edges(pieces);
  return triangulation.Ids64.empty() ? marksOf(triangulation.Ids32, edges)
                                     : marksOf(triangulation.Ids64, edges);
}

} // namespace tipp
