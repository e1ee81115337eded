// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Partitioned/FinishedPieces.h"
#include "Query/RankMesh.h"
#include "Resident/ForPieces.h"
#include "Resident/PieceNeighbors.h"

#include <algorithm>

namespace tipp
{
namespace
{

Ids storedNeighbors(
  const ResidentMesh& mesh, const Ids& cells, const PieceGroups& groups, std::size_t array)
{
  const auto corners = std::size_t(mesh.mesh().CellSize);
  Ids result(cells.size() * corners, -1);
  PieceNeeds needs = topologyNeeded();
  needs.Arrays.assign(mesh.mesh().Arrays.size(), false);
  needs.Arrays[array] = true;
  forPieces(mesh, groups, needs,
    [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
    {
      const PartValues values(*piece.Part, &mesh.mesh().Arrays[array]);
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t item = groups.Items[std::size_t(i)];
        CellLocation at;
        at.Cell = indexOf(mesh, *piece.Topology, cells[std::size_t(item)], false);
        values.sample(&at, &item, 1, reinterpret_cast<char*>(result.data()));
      }
    });
  return result;
}

/// The neighbours of cells that the pieces own.
Ids neighborsIn(const ResidentMesh& mesh, const Ids& cells, const std::vector<std::int32_t>& pieces)
{
  const std::vector<StoredArray>& arrays = mesh.mesh().Arrays;
  const int corners = mesh.mesh().CellSize;
  const auto stored = std::find_if(arrays.begin(), arrays.end(),
    [corners](const StoredArray& array)
    {
      return !array.OfPoints && array.Name == neighborIdsArray.Name &&
        array.Type == Scalar::Int64 && array.Components == corners && array.Step < 0;
    });
  const PieceGroups groups = groupByPiece(pieces);
  return mesh.isStored() && stored != arrays.end()
    ? storedNeighbors(mesh, cells, groups, std::size_t(stored - arrays.begin()))
    : computedNeighbors(mesh, groups, cells);
}

} // namespace

Ids neighborsOf(const ResidentMesh& mesh, const Ids& cells, Communicator* ranks)
{
  return listsOf(mesh, cells, false, ranks,
    [](const ResidentMesh& own, const Ids& ids, const std::vector<std::int32_t>& pieces)
    {
      IdLists lists;
      lists.Ids = neighborsIn(own, ids, pieces);
      for (std::size_t i = 0; i < ids.size(); ++i)
      {
        lists.Starts.push_back(lists.Starts.back() + own.mesh().CellSize);
      }
      return lists;
    })
    .Ids;
}

} // namespace tipp
