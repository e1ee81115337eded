// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHullRepair_h
#define tippHullRepair_h

#include "Triangulation/SeamMesh.h"

#include <vector>

namespace tipp
{

/// Removes the artificial points (Lemma 3): the triangles at them are replaced by those triangles
/// of the Delaunay triangulation of their true vertices that an artificial point is in conflict
/// with.
void removeArtificialPoints(
  std::vector<SeamTriangle>& final, const std::vector<SeamVertex>& artificial);

} // namespace tipp

#endif
