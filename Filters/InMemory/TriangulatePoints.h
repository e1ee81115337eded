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

/// The edges of lines, polygons and a boundary, in this order, as constraints between points of a
/// triangulation; and points in holes.
struct SourceConstraints
{
  std::vector<Constraint> Constraints;
  /// By constraint: the cell of a data set that it is an edge of, for messages. Empty if the
  /// constraints are not from a data set.
  std::vector<std::int64_t> Cells;
  std::size_t PolygonBegin = 0;  ///< constraints from here on are edges of polygons
  std::size_t BoundaryEdges = 0; ///< number of edges of the boundary, which come last
  std::vector<Point2> Holes = {};
};

/// Throws std::runtime_error if a constraint of a data set has a point id outside of [0, points).
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

/// Computes the triangulation of points in memory, for the tool, for vtkTIPPDelaunay2D and for
/// Python. Ids are indices into `points`, followed by the crossing points. With constraints,
/// triangles outside polygons, in holes and outside the boundary are left out: a triangle is inside
/// the boundary if a path to it from outside crosses the boundary's lines an odd number of times.
/// `warnings` receives a sentence for each problem. Throws std::invalid_argument if constraints
/// cross and must not, or have unknown points, and std::runtime_error for a polygon of a data set
/// with a corner that is not finite.
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
