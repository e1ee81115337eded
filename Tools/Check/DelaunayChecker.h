// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayChecker_h
#define tippDelaunayChecker_h

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

/// The result of checkDelaunay(). The members after the first block count faults.
struct CheckReport
{
  std::int64_t Points = 0;
  std::int64_t DistinctPoints = 0; ///< distinct points with finite coordinates
  std::int64_t Triangles = 0;
  std::int64_t BoundaryEdges = 0; ///< edges of one triangle
  std::int64_t Ties = 0;          ///< interior edges whose two triangles are on one circle

  /// Triangles with an id that does not exist, or whose point is not finite.
  std::int64_t BadIds = 0;
  std::int64_t BadTurns = 0;        ///< triangles that are clockwise or flat
  std::int64_t BadEdges = 0;        ///< edges in three or more triangles, or twice in one direction
  std::int64_t BadCircles = 0;      ///< interior edges with a point inside the neighbour's circle
  std::int64_t BadTies = 0;         ///< ties broken against the rule; counted with TieRule only
  std::int64_t UnusedPoints = 0;    ///< distinct points in no triangle
  std::int64_t TwinVertices = 0;    ///< vertices that have the coordinates of another vertex
  std::int64_t BadHullEdges = 0;    ///< boundary edges that are not in one convex closed chain
  std::int64_t LostConstraints = 0; ///< constraints that are no chain of edges
  std::int64_t OpenBoundary =
    0; ///< boundary edges, if IsCut, that are neither constraints nor on the hull
  /// Edges whose triangles do not store each other as neighbours; counted if `neighbors` are given.
  std::int64_t BadNeighbors = 0;
  /// Number of triangles less 2 n - 2 - h, for n distinct points and h boundary edges.
  std::int64_t EulerMismatch = 0;

  bool isCorrect() const { return this->faults().empty(); }

  /// Returns a line for each kind of fault, with its count.
  std::vector<std::string> faults() const;
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
