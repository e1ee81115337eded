// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulatePoints_h
#define tippTriangulatePoints_h

#include "Arrays/Buffer.h"
#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/ResolveCrossings.h"
#include "Triangulation/Triangulate.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

///@{
/// Merges close points, and calls triangulate() or tetrahedralize() for those that are left: by
/// ascending id, each point within `distance` of a point kept before it is merged into the first
/// such point. `distance` is in the points' unit of length. All ids of the result are indices into
/// `points`. Merging is one pass with a hash grid, in one thread; Progress can stop it.
VTKTIPPFILTERS_EXPORT Triangulation triangulateMerged(
  PointsView points, double distance, const TriangulationOptions& options = {});
VTKTIPPFILTERS_EXPORT Tetrahedralization tetrahedralizeMerged(const Point3* points,
  std::size_t count, double distance, const TetrahedralizationOptions& options = {});
///@}

/// The edges of lines and polygons as constraints between points of a triangulation.
struct SourceConstraints
{
  std::vector<Constraint> Constraints;
  std::vector<std::int64_t> Cells; ///< by constraint: the source's cell that it is an edge of
  std::size_t PolygonBegin = 0;    ///< constraints from here on are edges of polygons
};

/// Throws std::runtime_error if a constraint has a point id outside of [0, points).
VTKTIPPFILTERS_EXPORT void requireIds(const SourceConstraints& constraints, std::int64_t points);

/// How points in memory are triangulated.
struct PointsRequest
{
  TriangulationOptions Options;
  /// A point within this distance of a kept point of lower id is merged into it, in the points'
  /// unit of length; ignored with constraints. 0: only points with the same coordinates are merged.
  double Distance = 0;
  const SourceConstraints* Source = nullptr;    ///< null: none
  CrossingRule Crossings = CrossingRule::Split; ///< what to do with constraints that cross
};

/// Computes the triangulation that vtkTIPPDelaunay2D and Python return for points in memory. With
/// constraints, the polygons determine which triangles are kept. Ids are indices into `points`,
/// followed by the crossing points. `warnings` receives a sentence for each problem. Throws like
/// triangulateConstrained(), and std::runtime_error for a polygon with a non-finite corner.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulatePoints(
  PointsView points, const PointsRequest& request, std::vector<std::string>& warnings);

/// Computes the tetrahedra of points in memory. If all points lie in one plane there are none, and
/// `triangles` receives the result of triangulateCoplanar(). `distance`: see PointsRequest.
VTKTIPPFILTERS_EXPORT Tetrahedralization tetrahedralizePoints(const Point3* points,
  std::size_t count, double distance, const TetrahedralizationOptions& options,
  Triangulation& triangles);

/// Returns three values for each triangle: for each corner the index of the triangle across the
/// opposite edge, or -1.
Buffer<std::int64_t> neighborIds(const Triangulation& triangulation);

/// Returns four values for each tetrahedron: for each corner the index of the tetrahedron across
/// the opposite facet, or -1.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> neighborIds(const Tetrahedralization& mesh);

/// Returns three values for each triangle: for each corner 1 if the opposite edge is part of a
/// constraint, else 0.
Buffer<unsigned char> constraintMarks(
  const Triangulation& triangulation, const std::vector<IdSegment>& segments);

} // namespace tipp

#endif
