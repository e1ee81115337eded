// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckPartitioned_h
#define tippCheckPartitioned_h

#include "Check/DelaunayChecker.h"
#include "Points/ReadPoints.h"

#include <string>

namespace tipp
{

/// checkDelaunay() of a partitioned mesh and of points that are read block by block; one piece at a
/// time is in memory. Throws IOError, also if the mesh's points are not these.
CheckReport checkPartitioned(const std::string& points, const PointOptions& columns,
  const std::string& mesh, const CheckOptions& options);

} // namespace tipp

#endif
