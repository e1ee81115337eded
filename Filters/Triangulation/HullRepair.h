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
/// with. Vertices: these, each once. Returns corners by their places among them.
std::vector<std::array<std::uint32_t, 3>> hullTriangles(
  std::vector<Point2> vertices, const std::vector<SeamVertex>& artificial);

} // namespace tipp

#endif
