// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKeepInside_h
#define tippKeepInside_h

#include "Constraints/Constraint.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <vector>

namespace tipp
{

enum class InsideRule
{
  /// Inside is what the polygons go round counter-clockwise more often than clockwise. Where that
  /// is nothing, all polygons are holes: then all is inside but what they go round clockwise.
  Winding,
  EvenOdd ///< inside is what an odd number of polygons goes round
};

/// Removes the triangles outside of closed polygons, whose edges are edges of the triangulation.
VTKTIPPFILTERS_EXPORT void keepInside(Triangulation& triangulation,
  const std::vector<ConstraintPiece>& polygonEdges, InsideRule rule = InsideRule::Winding);

/// Removes the triangles that can be reached from seed points without crossing a constraint. Throws
/// std::invalid_argument for a seed in no triangle.
VTKTIPPFILTERS_EXPORT void removeHoles(PointsView points, Triangulation& triangulation,
  const std::vector<ConstraintPiece>& edges, const std::vector<Point2>& seeds);

} // namespace tipp

#endif
