// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSensibleRange_h
#define tippSensibleRange_h

#include "Predicates/Geometry.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// Returns the bounds along axes, such as "x from 0 to 1 and y from 2 to 3".
VTKTIPPACCELERATORS_EXPORT std::string inWords(
  const Box3& box, const std::vector<int>& axes = { 0, 1 });

/// Throws std::runtime_error if a range that a user gives does not meet the bounds of the points,
/// or is more than ten times as long along one of the axes: its numbers are probably in another
/// order, such as GDAL's xmin ymin xmax ymax, or in another coordinate reference system. Infinite
/// bounds are no mistake. An empty range is left to the callers.
VTKTIPPACCELERATORS_EXPORT void requireSensible(
  const Box3& range, const Box3& points, const std::vector<int>& axes = { 0, 1 });

} // namespace tipp

#endif
