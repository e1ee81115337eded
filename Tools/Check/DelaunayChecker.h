// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayChecker_h
#define tippDelaunayChecker_h

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Two point ids, the lower first.
using FixedEdge = std::array<std::int64_t, 2>;

struct CheckOptions
{
  /// Also require ties to be broken by the rule on coordinates that makes the triangulation unique:
  /// lifted to the paraboloid, the lexicographically largest of four co-circular points is raised,
  /// so the edge between them is the diagonal that does not end there.
  bool TieRule = false;
  /// The mesh has a boundary other than the convex hull, such as a coast: neither the hull nor
  /// Euler's formula is checked.
  bool BoundaryFree = false;
  /// Sorted edges of constraints, which need not be locally Delaunay.
  std::vector<FixedEdge> Constraints;
  /// Triangles outside of constraints are removed: every boundary edge must be a constraint or an
  /// edge of the convex hull, and points may be unused. Nothing else of the boundary is checked.
  bool IsCut = false;
};

/// The result of checkDelaunay(); all but the first block counts faults.
struct CheckReport
{
  std::int64_t Points = 0;
  std::int64_t DistinctPoints = 0; ///< with finite coordinates
  std::int64_t Triangles = 0;
  std::int64_t BoundaryEdges = 0; ///< edges of one triangle
  std::int64_t Ties = 0;          ///< interior edges whose four points are co-circular

  /// triangles with an id that is no point's, or a point's that is not finite
  std::int64_t BadIds = 0;
  std::int64_t BadTurns = 0;        ///< triangles clockwise or flat
  std::int64_t BadEdges = 0;        ///< edges in three or more triangles, or twice in one direction
  std::int64_t BadCircles = 0;      ///< interior edges with a point inside the circle
  std::int64_t BadTies = 0;         ///< ties broken against the rule, if it is required
  std::int64_t UnusedPoints = 0;    ///< distinct points in no triangle
  std::int64_t TwinVertices = 0;    ///< further ids in use for the coordinates of another vertex
  std::int64_t BadHullEdges = 0;    ///< boundary edges that are not in one convex closed chain
  std::int64_t LostConstraints = 0; ///< constraints that are no chain of edges
  std::int64_t OpenBoundary =
    0; ///< boundary edges, if IsCut, that are neither constraints nor on the hull
  /// edges whose triangles do not name each other, if `neighbors` are given
  std::int64_t BadNeighbors = 0;
  std::int64_t EulerMismatch = 0; ///< number of triangles minus (2 n - 2 - h)

  bool isCorrect() const { return this->faults().empty(); }

  /// One line per kind of fault, with its count.
  std::vector<std::string> faults() const;
};

/// Checks whether triangles (three point indices each) are the Delaunay triangulation of the
/// distinct finite points (x and y interleaved), by exact arithmetic and without computing a
/// triangulation: by Delaunay's lemma it suffices that counter-clockwise triangles are locally
/// Delaunay and meet edge to edge within one convex chain. Ties may be broken either way unless
/// TieRule is set. Fewer than three points, or collinear ones, have no triangles. `neighbors` holds
/// for each corner the index of the opposite triangle; empty: not checked.
CheckReport checkDelaunay(const std::vector<double>& xy, const std::vector<std::int64_t>& triangles,
  const CheckOptions& options = {}, const std::vector<std::int64_t>& neighbors = {});

} // namespace tipp

#endif
