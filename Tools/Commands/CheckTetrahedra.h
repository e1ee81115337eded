// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckTetrahedra_h
#define tippCheckTetrahedra_h

#include "Points/ReadPoints.h"

#include <string>

namespace tipp
{

/// Whether a file or a partitioned mesh is of tetrahedra. Throws IOError.
bool isOfTetrahedra(const std::string& mesh);

/// Checks tetrahedra in memory, and prints the result. Returns the exit code. Throws IOError, also
/// if the mesh's points are not these.
int runCheckTetrahedra(
  const std::string& points, const std::string& mesh, PointOptions columns, bool tieRule);

} // namespace tipp

#endif
