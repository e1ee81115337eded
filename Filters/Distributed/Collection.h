// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCollection_h
#define tippCollection_h

#include "Distributed/DistributedTriangulation.h"
#include "Distributed/PointExchange.h"
#include "Distributed/RankArrays.h"
#include "Messages/Communicator.h"

namespace tipp
{

/// The step after all partitions are done: sends boundary triangles to the rank that owns their
/// vertex of lowest id, where the interior triangles are, and fetches the points of other ranks
/// that these need. Collective.
template <typename Id>
void collect(Communicator& ranks, OwnedPoints<Id>& points, const std::vector<IdTriangle>& kept,
  const std::vector<std::size_t>& interiorCounts, std::vector<Duplicate> duplicates,
  const Tiling& leaves, int threads, DistributedTriangulation& result);

/// Fetches points from their owners. `ids` are internal ids, ascending; `firstIds` has each rank's
/// first id, and the end. Collective.
PointTuples fetchPoints(Communicator& ranks, const std::vector<std::int64_t>& ids,
  const std::vector<std::int64_t>& firstIds, const PointTuples& own, std::size_t rowSize);

/// For coincident points, gives the representative's entry in `points` the data of the point with
/// the lowest global id. The duplicates have internal ids on entry and global ids on return.
void preferLowestGlobalIds(
  PointTuples& points, std::int64_t firstId, std::vector<Duplicate>& duplicates);

extern template void collect(Communicator&, OwnedPoints<std::int32_t>&,
  const std::vector<IdTriangle>&, const std::vector<std::size_t>&, std::vector<Duplicate>,
  const Tiling&, int, DistributedTriangulation&);
extern template void collect(Communicator&, OwnedPoints<std::int64_t>&,
  const std::vector<IdTriangle>&, const std::vector<std::size_t>&, std::vector<Duplicate>,
  const Tiling&, int, DistributedTriangulation&);

} // namespace tipp

#endif
