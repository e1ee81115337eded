// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/TriangleExchange.h"

#include "Triangulation/TriangleSink.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// Converts internal ids to indices into Owned and, after these, Ghosts.
template <typename Id>
std::vector<typename TriangleSink<Id>::FinalTriangle> localised(
  const std::vector<IdTriangle>& triangles, const std::vector<std::int64_t>& ghosts,
  std::int64_t firstOwn, const Buffer<Point2>& positions, const Tiling& leaves)
{
  std::vector<typename TriangleSink<Id>::FinalTriangle> local;
  local.reserve(triangles.size());
  const auto indexOf = localIndices(firstOwn, positions.size(), ghosts);
  for (const IdTriangle& triangle : triangles)
  {
    typename TriangleSink<Id>::Corners ids;
    std::transform(triangle.begin(), triangle.end(), ids.begin(),
      [&indexOf](std::int64_t id) { return static_cast<Id>(indexOf(id)); });
    ids = TriangleSink<Id>::fromLowest(ids);
    local.push_back({ ids, leaves.locate(positions[std::size_t(ids[0])]) });
  }
  return local;
}

} // namespace

template <typename Id>
void collect(Communicator& ranks, OwnedPoints<Id>& points, const std::vector<IdTriangle>& kept,
  const std::vector<std::size_t>& interiorCounts, std::vector<Duplicate> duplicates,
  const Tiling& leaves, int threads, DistributedTriangulation& result)
{
  const std::size_t rowSize = result.RowSize;
  const std::int64_t firstOwn = points.FirstIds[std::size_t(ranks.rank())];
  result.FirstIds = points.FirstIds;
  const std::vector<IdTriangle> boundary = sendToOwners(ranks, kept, points.FirstIds);
  result.GhostIds = ghostIds(boundary, firstOwn, firstOwn + std::int64_t(points.size()));

  TriangleSink<Id> sink(points.Buckets);
  for (std::size_t leaf = 0; leaf < interiorCounts.size(); ++leaf)
  {
    sink.setInteriorCount(static_cast<PartitionIndex>(leaf), interiorCounts[leaf]);
  }
  Buffer<Id> ids = sink.assemble(
    { localised<Id>(boundary, result.GhostIds, firstOwn, points.Positions, leaves) }, threads);
  if constexpr (sizeof(Id) == 4)
  {
    result.Ids32 = std::move(ids);
  }
  else
  {
    result.Ids64 = std::move(ids);
  }

  result.Owned = std::move(static_cast<PointTuples&>(points));
  preferLowestGlobalIds(result.Owned, firstOwn, duplicates);
  result.Duplicates = std::move(duplicates);
  result.Ghosts = fetchPoints(ranks, result.GhostIds, points.FirstIds, result.Owned, rowSize);
}

template void collect(Communicator&, OwnedPoints<std::int32_t>&, const std::vector<IdTriangle>&,
  const std::vector<std::size_t>&, std::vector<Duplicate>, const Tiling&, int,
  DistributedTriangulation&);
template void collect(Communicator&, OwnedPoints<std::int64_t>&, const std::vector<IdTriangle>&,
  const std::vector<std::size_t>&, std::vector<Duplicate>, const Tiling&, int,
  DistributedTriangulation&);

std::vector<IdTriangle> trianglesByIds(const DistributedTriangulation& mine, int rank)
{
  const auto idOf = internalIds(mine, rank);
  std::vector<IdTriangle> triangles(mine.triangleCount());
  std::size_t corner = 0;
  mine.forEachCorner(
    [&](std::int64_t index)
    {
      triangles[corner / 3][corner % 3] = idOf(index);
      ++corner;
    });
  return triangles;
}

GhostTriangles fetchGhosts(Communicator& ranks, const DistributedTriangulation& mine)
{
  return fetchGhosts<Point2>(ranks, mine, trianglesByIds(mine, ranks.rank()), mine.FirstCell);
}

namespace
{

/// The triangles of all ranks on the first one, with idOf(index) for each corner.
template <typename IdOf>
Buffer<std::int64_t> gatherCorners(
  Communicator& ranks, const DistributedTriangulation& mine, const IdOf& idOf)
{
  Buffer<std::int64_t> ids(3 * mine.triangleCount());
  std::int64_t* to = ids.data();
  mine.forEachCorner([&](std::int64_t index) { *to++ = idOf(index); });
  return gatherValues(ranks, std::move(ids));
}

} // namespace

DistributedTriangulation gatherOnFirst(Communicator& ranks, DistributedTriangulation mine)
{
  mine.Ids64 = gatherCorners(ranks, mine, internalIds(mine, ranks.rank()));
  mine.Ids32 = {};
  gatherPoints(ranks, mine);
  mine.FirstCell = ranks.isFirst() ? 0 : mine.AllCells;
  return mine;
}

Triangulation gatherTriangles(Communicator& ranks, const DistributedTriangulation& mine)
{
  Triangulation result;
  result.Ids64 = gatherCorners(ranks, mine, globalIds(mine));
  gatherDuplicatesAndRejected(ranks, mine, result);
  return result;
}

} // namespace tipp
