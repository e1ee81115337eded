// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedraChecker_h
#define tippTetrahedraChecker_h

#include "Check/MeshReport.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The result of checkTetrahedra(). The members from BadFacets on count faults, as
/// do those of MeshReport from BadIds on.
struct TetrahedraReport : MeshReport
{
  std::int64_t Tetrahedra = 0;
  std::int64_t HullFacets = 0; ///< facets of one tetrahedron

  std::int64_t BadFacets = 0;  ///< facets of three or more tetrahedra, or of two on the same side
  std::int64_t BadSpheres = 0; ///< interior facets with a point inside the neighbour's sphere

  std::vector<std::string> faults() const override;
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
