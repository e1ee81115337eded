// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateConstrained_h
#define tippTriangulateConstrained_h

#include "Constraints/Constraint.h"
#include "Constraints/ResolveCrossings.h"
#include "vtkTIPPFiltersModule.h"

#include <functional>
#include <vector>

namespace tipp
{

struct ConstrainedTriangulation
{
  Triangulation Mesh; ///< of the points and, after them, the crossings
  /// The constraints as chains of edges between the points that stand for their vertices.
  ResolvedConstraints Constraints;
};

/// The constrained Delaunay triangulation of the distinct finite points: every constraint is a
/// chain of edges, and a triangle's circumdisk holds no vertex that it sees past the constraints;
/// ties are broken as without constraints. The same set of triangles for every option and order.
/// Throws as resolveCrossings() does. `cut` may remove triangles, as those outside of polygons; it
/// is called before triangles with too long an edge are removed.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulateConstrained(PointsView points,
  const std::vector<Constraint>& constraints, CrossingRule crossings = CrossingRule::Split,
  const TriangulationOptions& options = {},
  const std::function<void(ConstrainedTriangulation&)>& cut = {});

} // namespace tipp

#endif
