// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckTetrahedra_h
#define tippCheckTetrahedra_h

#include "Points/ReadPoints.h"

#include <string>

namespace tipp
{

/// Returns whether a file or partitioned mesh holds tetrahedra. Throws IOError.
bool isOfTetrahedra(const std::string& mesh);

/// Checks tetrahedra in memory and prints the result. Returns the exit code. Throws IOError if a
/// file cannot be read, or if the mesh was made from other points.
int runCheckTetrahedra(
  const std::string& points, const std::string& mesh, PointOptions columns, bool tieRule);

} // namespace tipp

#endif
