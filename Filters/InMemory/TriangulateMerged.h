// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateMerged_h
#define tippTriangulateMerged_h

#include "Triangulation/Triangulate.h"
#include "Triangulation3D/Tetrahedralize.h"

namespace tipp
{

/// The points that are left after merging: by ascending id, each point within the distance of a
/// point kept before it is merged into that one.
struct MergedPoints
{
  Buffer<double> Coordinates;        ///< x, y (in space also z) of the kept points
  Buffer<PointId> Ids;               ///< input point indices of the kept points, ascending
  std::vector<Duplicate> Duplicates; ///< merged points, with input indices
  std::vector<PointId> Rejected;     ///< input indices of points with NaN or infinite coordinates
  bool Aborted = false;              ///< whether `progress` stopped the pass
};

/// Merges close points in one pass with a hash grid. `distance` is in the points' unit of length.
/// If `progress` returns false, the pass ends and the result is Aborted. The result depends only on
/// the points and their order.
VTKTIPPFILTERS_EXPORT MergedPoints mergeClosePoints(
  PointsView points, double distance, const std::function<bool(double)>& progress = {});

///@{
/// Merges points closer than `distance` > 0, and calls triangulate() or tetrahedralize() for those
/// that are left. The result's ids are indices into `points`. Merging uses one thread.
VTKTIPPFILTERS_EXPORT Triangulation triangulateMerged(
  PointsView points, double distance, const TriangulationOptions& options = {});
VTKTIPPFILTERS_EXPORT Tetrahedralization tetrahedralizeMerged(const Point3* points,
  std::size_t count, double distance, const TetrahedralizationOptions& options = {});
///@}

} // namespace tipp

#endif
