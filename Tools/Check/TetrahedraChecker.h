// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedraChecker_h
#define tippTetrahedraChecker_h

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The result of checkTetrahedra(). The members after the first block count faults.
struct TetrahedraReport
{
  std::int64_t Points = 0;
  std::int64_t DistinctPoints = 0; ///< distinct points with finite coordinates
  std::int64_t Tetrahedra = 0;
  std::int64_t HullFacets = 0; ///< facets of one tetrahedron
  std::int64_t Ties = 0;       ///< interior facets whose two tetrahedra are on one sphere

  /// Tetrahedra with an id that does not exist, or whose point is not finite.
  std::int64_t BadIds = 0;
  std::int64_t BadTurns = 0;     ///< tetrahedra that are inverted or flat
  std::int64_t BadFacets = 0;    ///< facets of three or more tetrahedra, or of two on the same side
  std::int64_t BadSpheres = 0;   ///< interior facets with a point inside the neighbour's sphere
  std::int64_t BadTies = 0;      ///< ties broken against the rule; counted with `tieRule` only
  std::int64_t UnusedPoints = 0; ///< distinct points in no tetrahedron
  std::int64_t TwinVertices = 0; ///< vertices that have the coordinates of another vertex
  std::int64_t BadHullEdges = 0; ///< hull edges at which the hull is not closed or not convex
  std::int64_t EulerMismatch = 0; ///< vertices - edges + facets - tetrahedra - 1; also of the hull
  /// Corners with a wrong neighbour; counted if `neighbors` are given.
  std::int64_t BadNeighbors = 0;

  bool isCorrect() const { return this->faults().empty(); }

  /// Returns a line for each kind of fault, with its count.
  std::vector<std::string> faults() const;
};

/// Checks in exact arithmetic whether tetrahedra are the Delaunay triangulation of the distinct
/// finite points. It does not compute a triangulation: by Delaunay's lemma it is enough that the
/// tetrahedra are positively oriented, locally Delaunay, and meet facet to facet within one closed
/// convex surface. Ties between points on a sphere may be broken either way unless `tieRule` is
/// set. Points in one plane have no tetrahedra.
///
/// `xyz` holds the coordinates of each point, `tetrahedra` four indices of points each. `neighbors`
/// holds for each corner the index of the tetrahedron opposite to it, or -1; empty: not checked.
TetrahedraReport checkTetrahedra(const std::vector<double>& xyz,
  const std::vector<std::int64_t>& tetrahedra, bool tieRule,
  const std::vector<std::int64_t>& neighbors = {});

} // namespace tipp

#endif
