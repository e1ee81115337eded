// SPDX-License-Identifier: BSD-3-Clause
// What is exchanged of a finished triangulation in space.
#include "Distributed3D/DistributedTetrahedralization.h"

#include "Triangulation3D/OrderCells.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// The internal id of an index among owned and then foreign points.
auto internalIds(const DistributedTetrahedralization& mine, int rank)
{
  const std::int64_t first = mine.FirstIds[std::size_t(rank)];
  const auto own = std::int64_t(mine.Owned.size());
  return [&mine, first, own](std::int64_t index)
  { return index < own ? first + index : mine.ForeignIds[std::size_t(index - own)]; };
}

/// All ranks' tetrahedra on the first rank, with idOf(local index) for each corner, in order.
template <typename IdOf>
Buffer<std::int32_t> gatherCells(Communicator& ranks, const DistributedTetrahedralization& mine,
  std::int64_t points, const IdOf& idOf, int threads)
{
  if (points > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("more than 2,147,483,647 points in space are not supported on one "
                            "rank.");
  }
  Buffer<std::int32_t> ids(mine.Ids.size());
  std::transform(mine.Ids.begin(), mine.Ids.end(), ids.begin(),
    [&](std::int32_t index) { return std::int32_t(idOf(index)); });
  const Buffer<std::int32_t> all = gatherValues(ranks, std::move(ids));
  const auto* const cells = all.as<CellIds>();
  std::vector<std::vector<CellIds>> parts(1);
  parts[0].assign(cells, cells + all.size() / 4);
  return orderCells(std::move(parts), std::size_t(points), threads);
}

} // namespace

GhostTetrahedra fetchGhosts(Communicator& ranks, const DistributedTetrahedralization& mine)
{
  const auto idOf = internalIds(mine, ranks.rank());
  std::vector<IdCell<4>> cells(mine.cellCount());
  const auto* const local = mine.Ids.as<CellIds>();
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    std::transform(local[i].begin(), local[i].end(), cells[i].begin(), idOf);
  }
  return fetchGhosts<Point3>(ranks, mine, cells, mine.FirstCell);
}

DistributedTetrahedralization gatherOnFirst(
  Communicator& ranks, DistributedTetrahedralization mine, int threads)
{
  mine.Ids =
    gatherCells(ranks, mine, mine.FirstIds.back(), internalIds(mine, ranks.rank()), threads);
  mine.Owned.Positions = gatherValues(ranks, std::move(mine.Owned.Positions));
  mine.Owned.GlobalIds = gatherValues(ranks, std::move(mine.Owned.GlobalIds));
  mine.Owned.Rows = gatherValues(ranks, std::move(mine.Owned.Rows));
  mine.Foreign = {};
  mine.ForeignIds.clear();
  mine.Duplicates = gatherList(ranks, mine.Duplicates);
  mine.Rejected = gatherList(ranks, mine.Rejected);
  std::fill(mine.FirstIds.begin() + 1, mine.FirstIds.end(), std::int64_t(mine.Owned.size()));
  mine.FirstCell = ranks.isFirst() ? 0 : mine.AllCells;
  return mine;
}

Tetrahedralization gatherTetrahedra(
  Communicator& ranks, const DistributedTetrahedralization& mine, int threads)
{
  const auto own = std::int64_t(mine.Owned.size());
  Tetrahedralization all;
  all.Dimension = mine.Dimension;
  all.Ids = gatherCells(
    ranks, mine, mine.AllPoints,
    [&](std::int64_t index)
    {
      return index < own ? mine.Owned.GlobalIds[std::size_t(index)]
                         : mine.Foreign.GlobalIds[std::size_t(index - own)];
    },
    threads);
  all.Duplicates = gatherList(ranks, mine.Duplicates);
  all.Rejected = gatherList(ranks, mine.Rejected);
  std::sort(all.Rejected.begin(), all.Rejected.end());
  std::sort(all.Duplicates.begin(), all.Duplicates.end(),
    [](const Duplicate& a, const Duplicate& b) { return a.Point < b.Point; });
  return all;
}

} // namespace tipp
