// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGhostTriangles_h
#define tippGhostTriangles_h

#include "Distributed/DistributedTriangulation.h"
#include "Distributed/RankArrays.h"

#include <vector>

namespace tipp
{

/// Other ranks' triangles that share a vertex with one of this rank's: one layer.
struct GhostTriangles
{
  std::vector<IdTriangle> Triangles;  ///< counting all ranks' owned points
  std::vector<std::int64_t> Numbers;  ///< among all triangles, as FirstTriangle
  std::vector<std::int64_t> PointIds; ///< of their points that this rank has not; ascending
  PointTuples Points;                 ///< the same points
};

/// Collective.
VTKTIPPFILTERS_EXPORT GhostTriangles fetchGhosts(
  Postbox& ranks, const DistributedTriangulation& mine);

/// The triangles of a rank by ids that count all ranks' owned points.
VTKTIPPFILTERS_EXPORT std::vector<IdTriangle> trianglesByIds(
  const DistributedTriangulation& mine, int rank);

/// Everything on the first rank; nothing is left on the others. Collective.
VTKTIPPFILTERS_EXPORT DistributedTriangulation gatherOnFirst(
  Postbox& ranks, DistributedTriangulation mine);

} // namespace tipp

#endif
