// SPDX-License-Identifier: BSD-3-Clause
// Exchange of the cells of a finished triangulation in space.
#include "Distributed3D/DistributedTetrahedralization.h"

#include "Triangulation3D/OrderCells.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// Returns all ranks' cells on the first rank, sorted. Corners are given by idOf(local index).
template <typename IdOf>
Buffer<std::int32_t> gatherCells(Communicator& ranks, const DistributedTetrahedralization& mine,
  std::int64_t points, const IdOf& idOf, int threads)
{
  if (points > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("more than 2,147,483,647 points in space are not supported on one "
                            "rank.");
  }
  const auto convert = [&](std::int32_t index) { return std::int32_t(idOf(index)); };
  if (mine.cellSize() == 3)
  {
    Buffer<std::int32_t> ids(mine.Ids.size());
    std::transform(mine.Ids.begin(), mine.Ids.end(), ids.begin(), convert);
    ids = gatherValues(ranks, std::move(ids));
    orderTriangles(ids);
    return ids;
  }
  // All ranks sort their cells, and the first one merges them.
  std::vector<std::vector<CellIds>> cells(1);
  cells[0].reserve(mine.cellCount());
  std::transform(mine.Ids.as<CellIds>(), mine.Ids.as<CellIds>() + mine.cellCount(),
    std::back_inserter(cells[0]),
    [&](const CellIds& cell) -> CellIds {
      return { convert(cell[0]), convert(cell[1]), convert(cell[2]), convert(cell[3]) };
    });
  return mergeCells(
    ranks.gather(Bytes(orderCells(std::move(cells), std::size_t(points), threads))));
}

} // namespace

GhostTetrahedra fetchGhosts(Communicator& ranks, const DistributedTetrahedralization& mine)
{
  const auto idOf = internalIds(mine, ranks.rank());
  const std::size_t size = mine.cellSize();
  std::vector<IdCell<4>> cells(mine.cellCount());
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      cells[i][k] = idOf(mine.Ids[size * i + std::min(k, size - 1)]);
    }
  }
  return fetchGhosts<Point3>(ranks, mine, cells, mine.FirstCell);
}

DistributedTetrahedralization gatherOnFirst(
  Communicator& ranks, DistributedTetrahedralization mine, int threads)
{
  mine.Ids =
    gatherCells(ranks, mine, mine.FirstIds.back(), internalIds(mine, ranks.rank()), threads);
  gatherPoints(ranks, mine);
  mine.FirstCell = ranks.isFirst() ? 0 : mine.AllCells;
  return mine;
}

Tetrahedralization gatherTetrahedra(Communicator& ranks, const DistributedTetrahedralization& mine,
  int threads, Triangulation& triangles)
{
  Tetrahedralization all;
  all.Dimension = mine.Dimension;
  Buffer<std::int32_t> ids = gatherCells(ranks, mine, mine.AllPoints, globalIds(mine), threads);
  gatherDuplicatesAndRejected(ranks, mine, all);
  if (mine.Dimension == 2)
  {
    triangles.Ids32 = std::move(ids);
    triangles.Duplicates = all.Duplicates;
    triangles.Rejected = all.Rejected;
  }
  else
  {
    all.Ids = std::move(ids);
  }
  return all;
}

} // namespace tipp
