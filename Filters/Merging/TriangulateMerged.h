// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangulateMerged_h
#define tippTriangulateMerged_h

#include "Triangulation/Triangulate.h"

namespace tipp
{

/// The points left when, by ascending id, each one no farther than a distance from one kept
/// before it was merged into that one.
struct MergedPoints
{
  Buffer<double> Coordinates; ///< x, y of the kept points
  Buffer<PointId> Ids;        ///< their ids before merging, ascending
  std::vector<Duplicate> Duplicates;
  std::vector<PointId> Rejected; ///< NaN or infinite coordinates
  bool Aborted = false;
};

/// One pass over a hash grid; `progress`, if any, may end it with false. The result depends on
/// the points and their order alone.
VTKTIPPFILTERS_EXPORT MergedPoints mergeClosePoints(PointsView points,
  double distance,
  const std::function<bool(double)>& progress = {});

/// triangulate() of the points that mergeClosePoints() keeps, in the ids of `points`.
VTKTIPPFILTERS_EXPORT Triangulation triangulateMerged(PointsView points,
  double distance,
  const TriangulationOptions& options = {});

} // namespace tipp

#endif
