// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateMerged_h
#define tippTriangulateMerged_h

#include "Triangulation/Triangulate.h"
#include "Triangulation3D/Tetrahedralize.h"

namespace tipp
{

///@{
/// Merges close points, and calls triangulate() or tetrahedralize() for those that are left: by
/// ascending id, each point within `distance` of a point kept before it is merged into the first
/// such point. `distance` is in the points' unit of length. All ids of the result are indices into
/// `points`. Merging is one pass with a hash grid, in one thread; Progress can stop it.
VTKTIPPFILTERS_EXPORT Triangulation triangulateMerged(
  PointsView points, double distance, const TriangulationOptions& options = {});
VTKTIPPFILTERS_EXPORT Tetrahedralization tetrahedralizeMerged(const Point3* points,
  std::size_t count, double distance, const TetrahedralizationOptions& options = {});
///@}

} // namespace tipp

#endif
