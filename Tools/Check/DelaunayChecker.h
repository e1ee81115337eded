// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayChecker_h
#define tippDelaunayChecker_h

#include "Check/MeshReport.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// An edge that constraints fix: two point ids, the lower first.
using FixedEdge = std::array<std::int64_t, 2>;

struct CheckOptions
{
  /// Also require that ties are broken by the rule that makes the triangulation unique. With the
  /// points lifted to the paraboloid, the lexicographically largest of four co-circular points is
  /// raised. So the edge between the two triangles is the diagonal that does not end at this point.
  bool TieRule = false;
  /// The mesh has a boundary other than the convex hull, such as a coast. Neither the hull nor
  /// Euler's formula is checked.
  bool BoundaryFree = false;
  /// The edges of constraints, sorted. They need not be locally Delaunay.
  std::vector<FixedEdge> Constraints;
  /// Triangles outside of polygons have been removed. Every boundary edge must be a constraint or
  /// an edge of the convex hull, and points may be unused. Nothing else of the boundary is checked.
  bool IsCut = false;
};

/// The result of checkDelaunay(). The members from BadEdges on count faults, as do
/// those of MeshReport from BadIds on.
struct CheckReport : MeshReport
{
  std::int64_t Triangles = 0;
  std::int64_t BoundaryEdges = 0; ///< edges of one triangle

  std::int64_t BadEdges = 0;        ///< edges in three or more triangles, or twice in one direction
  std::int64_t BadCircles = 0;      ///< interior edges with a point inside the neighbour's circle
  std::int64_t LostConstraints = 0; ///< constraints that are no chain of edges
  /// Boundary edges, if IsCut, that are neither constraints nor on the hull.
  std::int64_t OpenBoundary = 0;

  std::vector<std::string> faults() const override;
};

/// Checks in exact arithmetic whether triangles are the Delaunay triangulation of the distinct
/// finite points. It does not compute a triangulation: by Delaunay's lemma it is enough that the
/// triangles are counter-clockwise, locally Delaunay, and meet edge to edge within a convex
/// boundary. Ties may be broken either way unless TieRule is set. Fewer than three points, or
/// collinear ones, have no triangles.
///
/// `xy` holds x and y of each point, `triangles` three indices of points each. `neighbors` holds
/// for each corner the index of the triangle opposite to it, or -1; empty: not checked.
CheckReport checkDelaunay(const std::vector<double>& xy, const std::vector<std::int64_t>& triangles,
  const CheckOptions& options = {}, const std::vector<std::int64_t>& neighbors = {});

} // namespace tipp

#endif
