// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMergeClosePoints3_h
#define tippMergeClosePoints3_h

#include "Triangulation3D/Tetrahedralize.h"

namespace tipp
{

/// Merges close points, and calls tetrahedralize() for those that are left. In ascending order of
/// ids, each point within `distance` > 0 of a kept point becomes a duplicate of the first such
/// point. All ids are indices into `points`; `distance` is in their unit of length. Merging uses
/// one thread. Throws like tetrahedralize().
VTKTIPPFILTERS_EXPORT Tetrahedralization tetrahedralizeMerged(const Point3* points,
  std::size_t count, double distance, const TetrahedralizationOptions& options = {});

} // namespace tipp

#endif
