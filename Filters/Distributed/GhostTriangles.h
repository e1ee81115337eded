// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGhostTriangles_h
#define tippGhostTriangles_h

#include "Distributed/DistributedTriangulation.h"
#include "Distributed/RankArrays.h"

#include <vector>

namespace tipp
{

/// One layer of ghosts: other ranks' triangles that share a vertex with one of this rank's.
struct GhostTriangles
{
  std::vector<IdTriangle> Triangles;  ///< by internal ids
  std::vector<std::int64_t> Numbers;  ///< indices among all ranks' triangles
  std::vector<std::int64_t> PointIds; ///< internal ids of the points this rank lacks; ascending
  PointTuples Points;                 ///< the points of PointIds
};

/// Returns the ghosts of this rank's triangles. Collective.
VTKTIPPFILTERS_EXPORT GhostTriangles fetchGhosts(
  Communicator& ranks, const DistributedTriangulation& mine);

/// A rank's triangles by internal ids: indices among all ranks' owned points.
VTKTIPPFILTERS_EXPORT std::vector<IdTriangle> trianglesByIds(
  const DistributedTriangulation& mine, int rank);

/// Moves everything to the first rank; the others return an empty triangulation. Collective.
VTKTIPPFILTERS_EXPORT DistributedTriangulation gatherOnFirst(
  Communicator& ranks, DistributedTriangulation mine);

} // namespace tipp

#endif
