// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleExchange_h
#define tippTriangleExchange_h

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

/// A triangle: three internal ids, indices among all ranks' owned points.
using IdTriangle = std::array<std::int64_t, 3>;

/// The rank that owns a point with an internal id; `firstIds` has each rank's first id, and the
/// end. Throws std::runtime_error if no rank owns it.
inline std::size_t ownerOf(std::int64_t id, const std::vector<std::int64_t>& firstIds)
{
  const auto next = std::upper_bound(firstIds.begin(), firstIds.end(), id);
  if (next == firstIds.begin() || next == firstIds.end())
  {
    throw std::runtime_error("A triangle from another rank is damaged: it has no such vertex.");
  }
  return std::size_t(next - firstIds.begin()) - 1;
}

/// The step after all partitions are done: sends boundary triangles to the rank that owns their
/// vertex of lowest id, adds them to its interior triangles, and fetches the points that they use
/// from other ranks. Collective.
template <typename Id>
void collect(Communicator& ranks, OwnedPoints<Id>& points, const std::vector<IdTriangle>& kept,
  const std::vector<std::size_t>& interiorCounts, std::vector<Duplicate> duplicates,
  const Tiling& leaves, int threads, DistributedTriangulation& result);

/// Fetches points from their owners. `ids` are internal ids, ascending; `firstIds` has each rank's
/// first id, and the end. Collective.
PointTuples fetchPoints(Communicator& ranks, const std::vector<std::int64_t>& ids,
  const std::vector<std::int64_t>& firstIds, const PointTuples& own, std::size_t rowSize);

/// For coincident points, copies the data of the point with the lowest global id to the
/// representative's entry in `points`. The duplicates have internal ids on entry and global ids on
/// return.
void preferLowestGlobalIds(
  PointTuples& points, std::int64_t firstId, std::vector<Duplicate>& duplicates);

extern template void collect(Communicator&, OwnedPoints<std::int32_t>&,
  const std::vector<IdTriangle>&, const std::vector<std::size_t>&, std::vector<Duplicate>,
  const Tiling&, int, DistributedTriangulation&);
extern template void collect(Communicator&, OwnedPoints<std::int64_t>&,
  const std::vector<IdTriangle>&, const std::vector<std::size_t>&, std::vector<Duplicate>,
  const Tiling&, int, DistributedTriangulation&);

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

/// Returns all ranks' triangles, duplicates and rejected points, by global ids, on the first rank;
/// an empty triangulation on the others. Collective.
VTKTIPPFILTERS_EXPORT Triangulation gatherTriangles(
  Communicator& ranks, const DistributedTriangulation& mine);

} // namespace tipp

#endif
