// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMergeClosePoints3_h
#define tippMergeClosePoints3_h

#include "Triangulation3D/Tetrahedralize.h"

namespace tipp
{

/// tetrahedralize() of the points that are left after merging: by ascending id, each point within
/// `distance` > 0 of a point kept before it is a duplicate of that one. Ids are indices into
/// `points`. Merging is serial.
VTKTIPPFILTERS_EXPORT Tetrahedralization tetrahedralizeMerged(const Point3* points,
  std::size_t count, double distance, const TetrahedralizationOptions& options = {});

} // namespace tipp

#endif
