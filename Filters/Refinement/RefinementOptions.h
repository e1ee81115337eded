// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRefinementOptions_h
#define tippRefinementOptions_h

#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace tipp
{

class PagedMemory;

/// A part of the domain, enclosed by segments: all triangles that can be reached from a point
/// without crossing one.
struct RefinementRegion
{
  Point2 Seed;
  double LargestArea = std::numeric_limits<double>::infinity();
};

struct RefinementOptions
{
  static constexpr double LargestAngle = 34; ///< above, refinement rarely ends

  /// No angle of the mesh is below this, in degrees, 0 to LargestAngle, except in the triangles of
  /// RefinedMesh::Outside. 20.7 is proved to end, up to 33 has been tried. 0: no bound.
  double MinimumAngle = 30;
  /// No triangle is larger, in the square of the points' unit.
  double LargestArea = std::numeric_limits<double>::infinity();
  /// A triangle's further limit: the area for its centroid and the distance to its farthest corner.
  /// It is called from several threads, and must depend on these only. Empty: none.
  std::function<double(Point2, double)> AreaAt;
  double LeastArea = 0; ///< a lower bound of AreaAt, which spares calls; 0: unknown
  std::vector<RefinementRegion> Regions;
  /// No edge is made that is shorter. What cannot be refined without one is left as it is. 0: 2^-36
  /// of the domain's longest side or 2^-44 of the largest coordinate, the larger one.
  double ShortestEdge = 0;
  bool KeepsBorder = false;   ///< no point is added on the border
  bool KeepsSegments = false; ///< no point is added on any segment
  /// The domain is what segments enclose: triangles that can be reached from outside the convex
  /// hull without crossing one are removed first. Otherwise it is all triangles that are given.
  bool IsEnclosed = false;
  std::int64_t MostPoints = 0; ///< at most so many points are added; 0: no limit
  int Threads = 0;             ///< 0: as usual
  /// Where the mesh and its result are; it must outlive the refinement. Null: the process's memory.
  PagedMemory* Memory = nullptr;
  Report Progress;
};

/// What RefinementOptions::AreaAt returns for a triangle.
inline double areaAt(
  const std::function<double(Point2, double)>& limit, const std::array<Point2, 3>& corners)
{
  const auto& [a, b, c] = corners;
  const Point2 centroid{ (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3 };
  double square = 0;
  for (const Point2 corner : corners)
  {
    const Point2 away = corner - centroid;
    square = std::max(square, away.x * away.x + away.y * away.y);
  }
  return limit(centroid, std::sqrt(square));
}

} // namespace tipp

#endif
