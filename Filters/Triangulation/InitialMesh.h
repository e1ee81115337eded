// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInitialMesh_h
#define tippInitialMesh_h

#include "Triangulation/BoundaryCells.h"
#include "Triangulation/Regions.h"

#include <vector>

namespace tipp
{

/// The Delaunay triangulation of the vertices, with the regions that each cell meets, and the pairs
/// of sets that adjacent cells meet.
template <int D>
BoundaryCells<D> triangulateVertices(
  const RegionsOf<D>& regions, const std::vector<VertexOf<Point<D>>>& vertices, int threads);

} // namespace tipp

#endif
