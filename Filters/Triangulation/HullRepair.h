// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHullRepair_h
#define tippHullRepair_h

#include "Triangulation/SeamMesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Removes the artificial points (Lemma 3): the triangles at them are replaced by those triangles
/// of the Delaunay triangulation of their true vertices that an artificial point is in conflict
/// with.
void removeArtificialPoints(
  std::vector<SeamTriangle>& final, const std::vector<SeamVertex>& artificial);

/// The same, of the true vertices alone: visits the triangles that take the place of those at the
/// artificial points, by places among the vertices, each of which comes once.
void visitHullTriangles(const std::vector<Point2>& vertices,
  const std::vector<SeamVertex>& artificial,
  const std::function<void(const std::array<std::uint32_t, 3>&)>& visit);

} // namespace tipp

#endif
