// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCollection_h
#define tippCollection_h

#include "Distributed/DistributedTriangulation.h"
#include "Distributed/PointExchange.h"
#include "Distributed/RankArrays.h"
#include "Messages/Postbox.h"

namespace tipp
{

/// What comes after all partitions are finished: boundary triangles go to the rank that owns their
/// vertex of lowest id, beside the interior ones; and the points of other ranks are fetched.
/// Collective.
template <typename Id>
void collect(Postbox& ranks, OwnedPoints<Id>& points, const std::vector<IdTriangle>& kept,
  const std::vector<std::size_t>& interiorCounts, std::vector<Duplicate> duplicates,
  const Tiling& leaves, int threads, DistributedTriangulation& result);

/// Asks the owners for the points named by ascending id. Collective.
PointTuples fetchPoints(Postbox& ranks, const std::vector<std::int64_t>& ids,
  const std::vector<std::int64_t>& firstIds, const PointTuples& own, std::size_t rowSize);

/// Among points at one place the representative's place in the output gets the data of the point
/// with the lowest global id. Duplicates are by internal ids, and by global ones afterwards.
void preferLowestGlobalIds(
  PointTuples& points, std::int64_t firstId, std::vector<Duplicate>& duplicates);

extern template void collect(Postbox&, OwnedPoints<std::int32_t>&, const std::vector<IdTriangle>&,
  const std::vector<std::size_t>&, std::vector<Duplicate>, const Tiling&, int,
  DistributedTriangulation&);
extern template void collect(Postbox&, OwnedPoints<std::int64_t>&, const std::vector<IdTriangle>&,
  const std::vector<std::size_t>&, std::vector<Duplicate>, const Tiling&, int,
  DistributedTriangulation&);

} // namespace tipp

#endif
