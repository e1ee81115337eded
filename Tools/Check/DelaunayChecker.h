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
  /// Also require the ties to be broken by the rule on coordinates that makes the triangulation
  /// unique: lifted to the paraboloid, the lexicographically largest of four co-circular points is
  /// raised, so the edge between them is the diagonal that does not end there.
  bool TieRule = false;
  /// The mesh has a boundary of its own, as a coast: no test of the hull and of Euler's count.
  bool BoundaryFree = false;
  /// Sorted edges of constraints, which need not be locally Delaunay.
  std::vector<FixedEdge> Constraints;
  /// Triangles outside of constraints are removed: every edge of the boundary is one of these or
  /// one of the convex hull, and points may be in no triangle. Nothing else of the boundary is
  /// tested.
  bool IsCut = false;
};

/// What checkDelaunay found; all but the first block counts faults.
struct CheckReport
{
  std::int64_t Points = 0;
  std::int64_t DistinctPoints = 0; ///< with finite coordinates
  std::int64_t Triangles = 0;
  std::int64_t BoundaryEdges = 0; ///< edges of one triangle
  std::int64_t Ties = 0;          ///< interior edges whose four points are co-circular

  std::int64_t BadIds = 0;          ///< triangles naming no point, or one that is not finite
  std::int64_t BadTurns = 0;        ///< triangles clockwise or flat
  std::int64_t BadEdges = 0;        ///< edges in three or more triangles, or twice in one direction
  std::int64_t BadCircles = 0;      ///< interior edges with a point inside the circle
  std::int64_t BadTies = 0;         ///< ties broken the other way, if asked for
  std::int64_t UnusedPoints = 0;    ///< distinct points in no triangle
  std::int64_t TwinVertices = 0;    ///< ids beyond the first used for one place
  std::int64_t BadHullEdges = 0;    ///< boundary edges that are not in one convex closed chain
  std::int64_t LostConstraints = 0; ///< constraints that are no chain of edges
  std::int64_t OpenBoundary =
    0; ///< boundary edges, if it is cut, that are not constraints or of the hull
  std::int64_t BadNeighbors = 0;  ///< edges whose triangles do not name each other, if they should
  std::int64_t EulerMismatch = 0; ///< triangles above (or, negative, below) 2 n - 2 - h

  bool isCorrect() const { return this->faults().empty(); }

  /// One line a kind of fault, with its count.
  std::vector<std::string> faults() const;
};

/// Whether triangles (three ids each) are the Delaunay triangulation of the distinct finite points
/// (x and y interleaved), by exact arithmetic and without a triangulation of its own: locally
/// Delaunay counter-clockwise triangles that meet edge to edge within one convex chain are that
/// (Delaunay's lemma). Ties may be broken either way unless asked for. Points that are fewer than
/// three or collinear have no triangles. `neighbors` are what triangles say of the one opposite to
/// each corner; empty: nothing.
CheckReport checkDelaunay(const std::vector<double>& xy, const std::vector<std::int64_t>& triangles,
  const CheckOptions& options = {}, const std::vector<std::int64_t>& neighbors = {});

} // namespace tipp

#endif
