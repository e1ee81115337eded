// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedraChecker_h
#define tippTetrahedraChecker_h

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The result of checkTetrahedra(); all but the first block counts faults.
struct TetrahedraReport
{
  std::int64_t Points = 0;
  std::int64_t DistinctPoints = 0; ///< with finite coordinates
  std::int64_t Tetrahedra = 0;
  std::int64_t HullFacets = 0; ///< facets of one tetrahedron
  std::int64_t Ties = 0;       ///< interior facets whose five points are on one sphere

  /// tetrahedra with an id that is no point's, or a point's that is not finite
  std::int64_t BadIds = 0;
  std::int64_t BadTurns = 0;      ///< tetrahedra inverted or flat
  std::int64_t BadFacets = 0;     ///< facets of three or more, or of two on the same side
  std::int64_t BadSpheres = 0;    ///< interior facets with a point inside the sphere
  std::int64_t BadTies = 0;       ///< ties broken against the rule, if it is required
  std::int64_t UnusedPoints = 0;  ///< distinct points in no tetrahedron
  std::int64_t TwinVertices = 0;  ///< further ids in use for the coordinates of another vertex
  std::int64_t BadHullEdges = 0;  ///< edges where the hull's facets are not closed and convex
  std::int64_t EulerMismatch = 0; ///< vertices - edges + facets - tetrahedra - 1, also of the hull
  std::int64_t BadNeighbors = 0;  ///< corners whose neighbour is another one, if they are given

  bool isCorrect() const { return this->faults().empty(); }

  /// One line per kind of fault, with its count.
  std::vector<std::string> faults() const;
};

/// Checks whether tetrahedra (four point indices each) are the Delaunay triangulation of the
/// distinct finite points (x, y, z interleaved), by exact arithmetic and without computing a
/// triangulation: by Delaunay's lemma it suffices that positively oriented tetrahedra are locally
/// Delaunay and meet facet to facet within one closed convex surface. Ties between points on a
/// sphere may be broken either way unless `tieRule` is set. Points in one plane have no tetrahedra.
/// `neighbors` holds for each corner the index of the opposite tetrahedron; empty: not checked.
TetrahedraReport checkTetrahedra(const std::vector<double>& xyz,
  const std::vector<std::int64_t>& tetrahedra, bool tieRule,
  const std::vector<std::int64_t>& neighbors = {});

} // namespace tipp

#endif
