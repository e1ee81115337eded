// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateConstrained_h
#define tippTriangulateConstrained_h

#include "Constraints/ConstraintEdges.h"
#include "Constraints/ResolveCrossings.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

struct ConstrainedTriangulation
{
  Triangulation Mesh; ///< of the points and, after them, the crossings
  /// The constraints as chains of edges between representatives of their vertices.
  ResolvedConstraints Constraints;
  std::int64_t Inverted = 0; ///< triangles that clockwise polygons alone surround: see keepInside()
};

/// Removes triangles of a triangulation of the points.
using CutTriangles = std::function<void(ConstrainedTriangulation&, PointsView)>;

/// Computes the constrained Delaunay triangulation of the distinct finite points. Every constraint
/// is a chain of edges. A triangle's circumdisk contains no vertex that is visible from the
/// triangle's interior, where constraints block the view. Ties are broken as without constraints.
/// The set of triangles does not depend on the options or on the order. Throws like
/// resolveCrossings(). `cut` may remove triangles, for example outside polygons; it is called with
/// the points and the crossings, before triangles with too long edges are removed.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulateConstrained(PointsView points,
  const std::vector<Constraint>& constraints, CrossingRule crossings = CrossingRule::Split,
  const TriangulationOptions& options = {}, const CutTriangles& cut = {});

} // namespace tipp

#endif
