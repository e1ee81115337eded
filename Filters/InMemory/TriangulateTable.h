// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateTable_h
#define tippTriangulateTable_h

#include "Constraints/TableConstraints.h"
#include "InMemory/TriangulatePoints.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPFiltersModule.h"

namespace tipp
{

/// Appends the constraints' own points to a table of points, except those already in it. In a
/// height column (see isHeightColumn()), a new point has the height given with the constraints; its
/// other values are NaN, unless TableConstraints::Surface is set. Returns the constraints between
/// the table's points.
VTKTIPPFILTERS_EXPORT SourceConstraints joinTable(
  PointTable& points, const TableConstraints& constraints, int threads);

/// Calls triangulatePoints() for the points of a table and constraints that have points of their
/// own. These are appended to the table unless it has them already, followed by the crossings.
/// Without constraints, which is the default, the table does not change. Throws
/// std::invalid_argument for constraints that cannot be used.
VTKTIPPFILTERS_EXPORT ConstrainedTriangulation triangulateTable(
  PointTable& points, const TableConstraints& constraints, const TriangulationOptions& options);

} // namespace tipp

#endif
