// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInterpolateSurface_h
#define tippInterpolateSurface_h

#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulate.h"

#include <array>
#include <vector>

namespace tipp
{

/// Where a point lies on a triangulated surface.
struct SurfacePlace
{
  std::array<PointId, 3> Corners{ -1, -1, -1 }; ///< -1: it lies outside
  std::array<double, 3> Weights{};

  /// The point's value, linear in the triangle; NaN outside.
  double valueOf(const std::vector<double>& values) const;
};

/// The places of the points after those of the surface. Of triangles at a point the first counts.
std::vector<SurfacePlace> placeOnSurface(
  PointsView surface, const Triangulation& triangles, PointsView all, int threads);

} // namespace tipp

#endif
