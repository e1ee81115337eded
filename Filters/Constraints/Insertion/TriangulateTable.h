// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateTable_h
#define tippTriangulateTable_h

#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/TableConstraints.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPFiltersModule.h"

namespace tipp
{

/// Computes the constrained Delaunay triangulation of the points and of the constraints' points.
/// The latter are appended to the table unless they exist already, followed by the crossings.
///
/// Removes triangles outside polygons, in holes, and outside the boundary: a triangle is inside the
/// boundary if a path to it from outside crosses the boundary's lines an odd number of times.
/// Throws std::invalid_argument.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulateTable(
  PointTable& points, const TableConstraints& constraints, const TriangulationOptions& options);

} // namespace tipp

#endif
