// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPythonTriangulationDict_h
#define tippPythonTriangulationDict_h

#include "Arrays.h"

#include "Triangulation/Triangulate.h"

namespace tipp::python
{

/// Points of shape (n, 2) or (n, 3), float32 or float64, where they lie.
PointsView viewOf(const InputArray& points);

/// A triangulation of so many points for Python: triangles, duplicates, rejected, warnings,
/// statistics and, if wanted, neighbors. Takes the triangles' memory.
nb::dict triangulationDict(
  Triangulation&& triangulation, std::size_t points, bool longEdgesLeftOut, bool wantsNeighbors);

} // namespace tipp::python

#endif
