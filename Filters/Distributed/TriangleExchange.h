// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleExchange_h
#define tippTriangleExchange_h

#include "Distributed/CellExchange.h"
#include "Distributed/DistributedTriangulation.h"
#include "Distributed/PointExchange.h"
#include "Ranks/Communicator.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace tipp
{

using IdTriangle = IdCell<3>;
using GhostTriangles = GhostCells<3, Point2>;

/// The step after all partitions are done: sends boundary triangles to the rank that owns their
/// vertex of lowest id, adds them to its interior triangles, and fetches the points that they use
/// from other ranks. Collective.
template <typename Id>
void collect(Communicator& ranks, OwnedPoints<Id>& points, const std::vector<IdTriangle>& kept,
  const std::vector<std::size_t>& interiorCounts, std::vector<Duplicate> duplicates,
  const Tiling& leaves, int threads, DistributedTriangulation& result);

extern template void collect(Communicator&, OwnedPoints<std::int32_t>&,
  const std::vector<IdTriangle>&, const std::vector<std::size_t>&, std::vector<Duplicate>,
  const Tiling&, int, DistributedTriangulation&);
extern template void collect(Communicator&, OwnedPoints<std::int64_t>&,
  const std::vector<IdTriangle>&, const std::vector<std::size_t>&, std::vector<Duplicate>,
  const Tiling&, int, DistributedTriangulation&);

/// Returns the ghosts of this rank's triangles. Collective.
VTKTIPPFILTERS_EXPORT GhostTriangles fetchGhosts(
  Communicator& ranks, const DistributedTriangulation& mine);

/// A rank's triangles by internal ids: indices among all ranks' owned points.
VTKTIPPFILTERS_EXPORT std::vector<IdTriangle> trianglesByIds(
  const DistributedTriangulation& mine, int rank);

/// Moves everything to the first rank; the others return an empty triangulation. Collective.
VTKTIPPFILTERS_EXPORT DistributedTriangulation gatherOnFirst(
  Communicator& ranks, DistributedTriangulation mine);

/// Returns all ranks' triangles, duplicates and rejected points, by global ids, on the first rank;
/// an empty triangulation on the others. Collective.
VTKTIPPFILTERS_EXPORT Triangulation gatherTriangles(
  Communicator& ranks, const DistributedTriangulation& mine);

} // namespace tipp

#endif
