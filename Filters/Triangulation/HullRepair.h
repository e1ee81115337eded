// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHullRepair_h
#define tippHullRepair_h

#include "Triangulation/SeamTriangles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Removes the artificial points (Lemma 3): the triangles at them are replaced by those triangles
/// of the Delaunay triangulation of their true vertices that an artificial point is in conflict
/// with.
void removeArtificialPoints(
  std::vector<SeamTriangle>& final, const std::vector<SeamVertex>& artificial);

/// The triangles that take the place of those at the artificial points, of these points' true
/// vertices, each of which comes once; by places among them.
std::vector<std::array<std::uint32_t, 3>> hullTriangles(
  std::vector<Point2> vertices, const std::vector<SeamVertex>& artificial);

} // namespace tipp

#endif
