// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulatePoints_h
#define tippTriangulatePoints_h

#include "Arrays/Buffer.h"
#include "Constraints/TriangulateConstrained.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The edges of lines and polygons as constraints between points of a triangulation.
struct SourceConstraints
{
  std::vector<Constraint> Constraints;
  std::vector<std::int64_t> Cells; ///< of each constraint: the cell that it is an edge of
  std::size_t PolygonBegin = 0;    ///< constraints from here on are edges of polygons
};

/// Throws std::runtime_error for a constraint that names a point beyond the `points` ones.
VTKTIPPFILTERS_EXPORT void requireIds(const SourceConstraints& constraints, std::int64_t points);

/// How points in memory are triangulated.
struct PointsRequest
{
  TriangulationOptions Options;
  /// A point no farther than this from a kept point of lower id is merged into it, in the points'
  /// unit of length; not used with constraints. 0: only points with the same coordinates.
  double Distance = 0;
  const SourceConstraints* Source = nullptr; ///< null: none
  CrossingRule Crossings = CrossingRule::Split;
};

/// The triangulation of points in memory that vtkTIPPDelaunay2D and Python return. Of constraints
/// the polygons tell which triangles are kept. Ids are indices into `points`, after which come the
/// crossings. `warnings` receives a sentence for each problem. Throws as triangulateConstrained()
/// does, and std::runtime_error for a polygon with a corner that is not finite.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulatePoints(
  PointsView points, const PointsRequest& request, std::vector<std::string>& warnings);

/// Returns three values for each triangle: for each corner the index of the triangle across the
/// opposite edge, or -1.
Buffer<std::int64_t> neighborIds(const Triangulation& triangulation);

/// Returns for each of `points` input points the id of its representative: its own id, for a
/// duplicate the representative's, for a rejected point -1.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> representativeIds(
  const Triangulation& triangulation, std::int64_t points);

/// Returns three values for each triangle: for each corner 1 if the edge opposite to it is one of a
/// constraint, else 0.
Buffer<unsigned char> constraintMarks(
  const Triangulation& triangulation, const std::vector<ConstraintPiece>& pieces);

} // namespace tipp

#endif
