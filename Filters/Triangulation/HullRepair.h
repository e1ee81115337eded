// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHullRepair_h
#define tippHullRepair_h

#include "Triangulation/BoundaryTriangles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Removes the artificial points (Lemma 3): the triangles at them are replaced by those triangles
/// of the Delaunay triangulation of their true vertices that are in conflict with an artificial
/// point. `vertices` are these true vertices, each once. Returns the corners of the replacement
/// triangles as indices into `vertices`.
std::vector<std::array<std::uint32_t, 3>> hullTriangles(
  std::vector<Point2> vertices, const std::vector<BoundaryVertex>& artificial);

} // namespace tipp

#endif
