// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayConstraints_h
#define tippDelaunayConstraints_h

#include "Commands/DelaunayArguments.h"
#include "Points/PointTable.h"
#include "Triangulation/Triangulate.h"

#include <string>

namespace tipp
{

/// Triangulates with the constraints that --constraints names. Points of their file that are not
/// among the points are appended, then the points where constraints cross. A column of an appended
/// point is the height in the constraints' file if the column is named z, else NaN; a column of a
/// crossing is interpolated. `report` receives a line about the constraints. Throws IOError.
Triangulation triangulateWithConstraints(const DelaunayArguments& arguments, PointTable& points,
  const TriangulationOptions& options, std::string& report);

} // namespace tipp

#endif
