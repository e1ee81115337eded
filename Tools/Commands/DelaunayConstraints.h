// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayConstraints_h
#define tippDelaunayConstraints_h

#include "Commands/DelaunayArguments.h"
#include "Constraints/ConstraintTable.h"
#include "Points/PointTable.h"
#include "Triangulation/Triangulate.h"

#include <string>

namespace tipp
{

/// Reads the closed lines of a boundary. Throws IOError.
ConstraintTable readBoundary(const std::string& path);

/// Triangulates with the constraints that --constraints and --boundary name. The points of their
/// files that are not among the points come after these, then the points where constraints cross. A
/// column of the new points is what the constraints' file has as height, if it is named z; else
/// NaN. A column of a crossing is interpolated. `report` becomes a line about the constraints.
/// Throws IOError.
Triangulation triangulateWithConstraints(const DelaunayArguments& arguments, PointTable& points,
  const TriangulationOptions& options, std::string& report);

} // namespace tipp

#endif
