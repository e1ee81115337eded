// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellExchange_h
#define tippCellExchange_h

#include "Arrays/Buffer.h"
#include "Arrays/Concatenated.h"
#include "Parallel/Sort.h"
#include "Ranks/Archive.h"
#include "Ranks/Communicator.h"
#include "Triangulation/Triangulate.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{

/// Ids and data of a rank's input points. Does not own the memory.
struct RankPointData
{
  const PointId* GlobalIds = nullptr; ///< null: consecutive ids from FirstId
  PointId FirstId = 0;                ///< global id of the first point, if GlobalIds is null
  /// Data sent with each point: RowSize bytes, which PackRow(point index, to) writes.
  std::size_t RowSize = 0;
  std::function<void(std::size_t, char*)> PackRow;

  PointId globalId(std::size_t i) const
  {
    return this->GlobalIds ? this->GlobalIds[i] : this->FirstId + PointId(i);
  }
};

/// Points with their global ids and data; the arrays have the same order.
template <typename Position>
struct PointTuplesOf
{
  PointTuplesOf() = default;
  /// Uninitialised memory for `count` points with `rowSize` bytes of data each.
  PointTuplesOf(std::size_t count, std::size_t rowSize)
    : Positions(count)
    , GlobalIds(count)
    , Rows(count * rowSize)
  {
  }

  Buffer<Position> Positions; ///< coordinates, one per point
  Buffer<PointId> GlobalIds;  ///< the caller's ids, one per point
  Buffer<char> Rows;          ///< as RankPointData::PackRow wrote them
  std::size_t size() const { return this->Positions.size(); }
};

/// The points of a rank's part of a triangulation, and totals over all ranks. Cells refer to points
/// by local indices: of Owned, and after them of Ghosts. An internal id is a point's index among
/// all ranks' owned points, rank by rank; a global id is the id that the caller gave the point.
template <typename Position>
struct DistributedPoints
{
  PointTuplesOf<Position> Owned;      ///< this rank's points, also those without cells here
  PointTuplesOf<Position> Ghosts;     ///< other ranks' points that this rank's cells use
  std::size_t RowSize = 0;            ///< bytes of data per point
  std::vector<std::int64_t> GhostIds; ///< internal ids of Ghosts; ascending
  std::vector<std::int64_t> FirstIds; ///< first internal id of each rank, and the end
  std::vector<Duplicate> Duplicates;  ///< found on this rank; global ids
  std::vector<PointId> Rejected;      ///< rejected points of this rank's input; global ids
  std::int64_t AllPoints = 0;         ///< sum over all ranks, as the following ones
  std::int64_t AllDuplicates = 0;
  std::int64_t AllRejected = 0;
  std::int64_t AllCells = 0;
  std::int64_t FirstCell = 0; ///< index of this rank's first cell among all ranks'

  /// The coordinates of Owned and, after these, of Ghosts.
  std::vector<Position> positions() const
  {
    std::vector<Position> all(this->Owned.Positions.begin(), this->Owned.Positions.end());
    all.insert(all.end(), this->Ghosts.Positions.begin(), this->Ghosts.Positions.end());
    return all;
  }

  /// Divides all coordinates by a power of two.
  void divideBy(double factor)
  {
    if (factor == 1)
    {
      return;
    }
    for (Buffer<Position>* points : { &this->Owned.Positions, &this->Ghosts.Positions })
    {
      auto* const first = points->template as<double>();
      std::for_each(first, first + points->size() * (sizeof(Position) / sizeof(double)),
        [factor](double& x) { x /= factor; });
    }
  }
};

/// A cell: N internal ids, indices among all ranks' owned points.
template <std::size_t N>
using IdCell = std::array<std::int64_t, N>;

/// One layer of ghosts: other ranks' cells that share a vertex with one of this rank's.
template <std::size_t N, typename Position>
struct GhostCells
{
  std::vector<IdCell<N>> Cells;
  std::vector<std::int64_t> Numbers;  ///< indices among all ranks' cells
  std::vector<std::int64_t> PointIds; ///< internal ids of the points this rank lacks; ascending
  PointTuplesOf<Position> Points;     ///< the points of PointIds
};

/// The index of each rank's first item, and the end, where this rank has `count` items. Collective.
inline std::vector<std::int64_t> firstIndices(Communicator& ranks, std::int64_t count)
{
  std::vector<std::int64_t> firsts(std::size_t(ranks.size()) + 1, 0);
  firsts[std::size_t(ranks.rank()) + 1] = count;
  ranks.sum(firsts);
  std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
  return firsts;
}

/// The rank that owns a point with an internal id; `firstIds` has each rank's first id, and the
/// end. Throws std::runtime_error if no rank owns it.
inline std::size_t ownerOf(std::int64_t id, const std::vector<std::int64_t>& firstIds)
{
  const auto next = std::upper_bound(firstIds.begin(), firstIds.end(), id);
  if (next == firstIds.begin() || next == firstIds.end())
  {
    throw std::runtime_error("A cell from another rank is damaged: it has no such vertex.");
  }
  return std::size_t(next - firstIds.begin()) - 1;
}

/// Sets the numbers of cells of a mesh, of which this rank has `count`, also in the statistics of
/// ranks if there are any yet. Collective.
template <typename Mesh>
void numberCells(Communicator& ranks, std::size_t count, Mesh& mine)
{
  const std::vector<std::int64_t> firsts = firstIndices(ranks, std::int64_t(count));
  mine.FirstCell = firsts[std::size_t(ranks.rank())];
  mine.AllCells = firsts.back();
  for (std::size_t rank = 0; rank < mine.Statistics.Ranks.size(); ++rank)
  {
    mine.Statistics.Ranks[rank].Triangles = firsts[rank + 1] - firsts[rank];
  }
}

/// Sends each cell to the rank that owns its vertex of lowest id, and returns those received.
/// Collective.
template <std::size_t N>
std::vector<IdCell<N>> sendToOwners(Communicator& ranks, const std::vector<IdCell<N>>& cells,
  const std::vector<std::int64_t>& firstIds)
{
  const auto owner = [&firstIds](const IdCell<N>& cell)
  { return ownerOf(*std::min_element(cell.begin(), cell.end()), firstIds); };
  std::vector<std::size_t> counts(static_cast<std::size_t>(ranks.size()), 0);
  for (const IdCell<N>& cell : cells)
  {
    ++counts[owner(cell)];
  }
  std::vector<std::vector<IdCell<N>>> sorted(counts.size());
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    sorted[rank].reserve(counts[rank]);
  }
  for (const IdCell<N>& cell : cells)
  {
    sorted[owner(cell)].push_back(cell);
  }
  return concatenated(ranks.allToAll(sorted));
}

/// The ids of cells' vertices outside of [firstOwn, endOwn), ascending.
template <std::size_t N>
std::vector<std::int64_t> ghostIds(
  const std::vector<IdCell<N>>& cells, std::int64_t firstOwn, std::int64_t endOwn)
{
  std::vector<std::int64_t> ids;
  for (const IdCell<N>& cell : cells)
  {
    std::copy_if(cell.begin(), cell.end(), std::back_inserter(ids),
      [&](std::int64_t id) { return id < firstOwn || id >= endOwn; });
  }
  sortUnique(ids);
  return ids;
}

/// Returns a function from internal ids to local indices: of own points, the first of which has the
/// id `firstOwn`, and of `ghosts`, the ascending ids of others.
inline auto localIndices(
  std::int64_t firstOwn, std::size_t own, const std::vector<std::int64_t>& ghosts)
{
  return [firstOwn, endOwn = firstOwn + std::int64_t(own), &ghosts](std::int64_t id)
  {
    return firstOwn <= id && id < endOwn
      ? id - firstOwn
      : endOwn - firstOwn + (std::lower_bound(ghosts.begin(), ghosts.end(), id) - ghosts.begin());
  };
}

/// Fetches points from their owners. `ids` are internal ids, ascending; `firstIds` has each rank's
/// first id, and the end. Collective.
template <typename Position>
PointTuplesOf<Position> fetchPoints(Communicator& ranks, const std::vector<std::int64_t>& ids,
  const std::vector<std::int64_t>& firstIds, const PointTuplesOf<Position>& own,
  std::size_t rowSize)
{
  std::vector<std::vector<std::int64_t>> requests;
  auto begin = ids.begin();
  for (int rank = 0; rank < ranks.size(); ++rank)
  {
    const auto end = std::lower_bound(begin, ids.end(), firstIds[std::size_t(rank) + 1]);
    requests.emplace_back(begin, end);
    begin = end;
  }
  std::vector<Bytes> answers;
  const std::int64_t firstOwn = firstIds[std::size_t(ranks.rank())];
  for (const std::vector<std::int64_t>& request : ranks.allToAll(requests))
  {
    SaveArchive writer;
    for (const std::int64_t id : request)
    {
      const std::size_t at = std::size_t(id - firstOwn);
      if (at >= own.size())
      {
        throw std::runtime_error("Another rank asks for a point that is not here.");
      }
      writer(own.Positions[at]);
      writer(own.GlobalIds[at]);
      writer.raw(own.Rows.data() + at * rowSize, rowSize);
    }
    answers.push_back(writer.take());
  }
  PointTuplesOf<Position> fetched(ids.size(), rowSize);
  std::size_t at = 0;
  for (const Bytes& answer : ranks.allToAll(std::move(answers)))
  {
    for (LoadArchive reader(answer); reader.left() > 0; ++at)
    {
      if (at == ids.size())
      {
        throw std::runtime_error("Another rank has sent more points than it was asked for.");
      }
      fetched.Positions[at] = reader.get<Position>();
      fetched.GlobalIds[at] = reader.get<PointId>();
      const char* row = reader.raw(rowSize);
      std::copy(row, row + rowSize, fetched.Rows.data() + at * rowSize);
    }
  }
  if (at != ids.size())
  {
    throw std::runtime_error("Other ranks have sent fewer points than they were asked for.");
  }
  return fetched;
}

/// For coincident points, gives the representative's entry in `points` the data of the point with
/// the lowest global id. The duplicates have internal ids on entry and global ids on return.
template <typename Position>
void preferLowestGlobalIds(
  PointTuplesOf<Position>& points, std::int64_t firstId, std::vector<Duplicate>& duplicates)
{
  const std::size_t rowSize = points.size() > 0 ? points.Rows.size() / points.size() : 0;
  std::map<std::size_t, std::size_t> lowest; // by representative: lowest global id's
  for (const Duplicate& duplicate : duplicates)
  {
    const std::size_t representative = std::size_t(duplicate.Representative - firstId);
    const std::size_t point = std::size_t(duplicate.Point - firstId);
    std::size_t& best = lowest.emplace(representative, representative).first->second;
    best = points.GlobalIds[point] < points.GlobalIds[best] ? point : best;
  }
  for (const auto& [representative, best] : lowest)
  {
    if (representative != best)
    {
      std::swap(points.GlobalIds[representative], points.GlobalIds[best]);
      char* rows = points.Rows.data();
      std::swap_ranges(rows + representative * rowSize, rows + (representative + 1) * rowSize,
        rows + best * rowSize);
    }
  }
  for (Duplicate& duplicate : duplicates)
  {
    duplicate = { points.GlobalIds[std::size_t(duplicate.Point - firstId)],
      points.GlobalIds[std::size_t(duplicate.Representative - firstId)] };
  }
  std::sort(duplicates.begin(), duplicates.end());
}

/// For each vertex that this rank shares, by internal id, the other ranks with cells at it.
using VertexUsers = std::map<std::int64_t, std::vector<std::int32_t>>;

struct SharedVertex
{
  std::int64_t Id;
  std::int64_t User;
};

/// Returns, by rank, the internal ids of this rank's points that the rank uses. Collective.
template <typename Mesh>
std::vector<std::vector<std::int64_t>> findUsedByOthers(Communicator& ranks, const Mesh& mine)
{
  std::vector<std::vector<std::int64_t>> asked(std::size_t(ranks.size()));
  for (const std::int64_t id : mine.GhostIds)
  {
    asked[ownerOf(id, mine.FirstIds)].push_back(id);
  }
  return ranks.allToAll(asked);
}

/// Each rank sends the ids of the points that it uses to their owners. Each owner returns, to all
/// ranks that use a point, the list of these ranks.
/// Collective.
template <typename Mesh, std::size_t N>
VertexUsers findUsers(Communicator& ranks, const Mesh& mine, const std::vector<IdCell<N>>& cells)
{
  const std::int64_t firstOwn = mine.FirstIds[std::size_t(ranks.rank())];
  std::vector<char> used(mine.Owned.size(), 0);
  for (const IdCell<N>& cell : cells)
  {
    for (const std::int64_t id : cell)
    {
      const std::size_t at = std::size_t(id - firstOwn);
      if (at < used.size())
      {
        used[at] = 1;
      }
    }
  }
  VertexUsers ofOwn;
  const auto requests = findUsedByOthers(ranks, mine);
  for (std::size_t user = 0; user < requests.size(); ++user)
  {
    for (const std::int64_t id : requests[user])
    {
      std::vector<std::int32_t>& users = ofOwn[id];
      if (users.empty() && used.at(std::size_t(id - firstOwn)))
      {
        users.push_back(ranks.rank());
      }
      users.push_back(std::int32_t(user));
    }
  }
  std::vector<std::vector<SharedVertex>> sharers(std::size_t(ranks.size()));
  for (const auto& [id, users] : ofOwn)
  {
    for (const std::int32_t user : users)
    {
      for (const std::int32_t other : users)
      {
        if (other != user)
        {
          sharers[std::size_t(user)].push_back({ id, other });
        }
      }
    }
  }
  VertexUsers users;
  for (const auto& part : ranks.allToAll(sharers))
  {
    for (const SharedVertex& shared : part)
    {
      users[shared.Id].push_back(std::int32_t(shared.User));
    }
  }
  return users;
}

/// Returns the ghosts of this rank's cells. Collective.
template <typename Position, std::size_t N>
GhostCells<N, Position> fetchGhosts(
  Communicator& ranks, const DistributedPoints<Position>& mine, const std::vector<IdCell<N>>& cells)
{
  struct Sent
  {
    IdCell<N> Corners;
    std::int64_t Number;
  };
  const VertexUsers users = findUsers(ranks, mine, cells);
  std::vector<std::vector<Sent>> toRanks(std::size_t(ranks.size()));
  for (std::size_t t = 0; t < cells.size(); ++t)
  {
    std::set<std::int32_t> to;
    for (const std::int64_t id : cells[t])
    {
      const auto shared = users.find(id);
      if (shared != users.end())
      {
        to.insert(shared->second.begin(), shared->second.end());
      }
    }
    for (const std::int32_t rank : to)
    {
      toRanks[std::size_t(rank)].push_back({ cells[t], mine.FirstCell + std::int64_t(t) });
    }
  }
  GhostCells<N, Position> ghosts;
  const std::int64_t firstOwn = mine.FirstIds[std::size_t(ranks.rank())];
  const std::int64_t endOwn = mine.FirstIds[std::size_t(ranks.rank()) + 1];
  for (const auto& part : ranks.allToAll(toRanks))
  {
    for (const Sent& sent : part)
    {
      ghosts.Cells.push_back(sent.Corners);
      ghosts.Numbers.push_back(sent.Number);
      for (const std::int64_t id : sent.Corners)
      {
        if ((id < firstOwn || id >= endOwn) &&
          !std::binary_search(mine.GhostIds.begin(), mine.GhostIds.end(), id))
        {
          ghosts.PointIds.push_back(id);
        }
      }
    }
  }
  sortUnique(ghosts.PointIds);
  ghosts.Points = fetchPoints(ranks, ghosts.PointIds, mine.FirstIds, mine.Owned, mine.RowSize);
  return ghosts;
}

/// Returns a function from the local indices of a mesh on `rank` (see DistributedPoints) to
/// internal ids.
template <typename Mesh>
auto internalIds(const Mesh& mine, int rank)
{
  const std::int64_t first = mine.FirstIds[std::size_t(rank)];
  const auto own = std::int64_t(mine.Owned.size());
  return [&mine, first, own](std::int64_t index)
  { return index < own ? first + index : mine.GhostIds[std::size_t(index - own)]; };
}

/// Adds cells, which have internal ids, to those of a mesh, whose corners are local indices.
/// Fetches other ranks' points that the cells need, and removes those that no cell uses.
/// Collective.
template <typename Id, std::size_t N, typename Mesh>
void addCells(
  Communicator& ranks, const std::vector<IdCell<N>>& added, Buffer<Id>& corners, Mesh& mine)
{
  const std::int64_t first = mine.FirstIds[std::size_t(ranks.rank())];
  const std::size_t own = mine.Owned.size();
  std::vector<std::int64_t> ghosts = ghostIds(added, first, first + std::int64_t(own));
  for (const Id corner : corners)
  {
    if (std::size_t(corner) >= own)
    {
      ghosts.push_back(mine.GhostIds[std::size_t(corner) - own]);
    }
  }
  sortUnique(ghosts);
  const auto idOf = internalIds(mine, ranks.rank());
  const auto indexOf = localIndices(first, own, ghosts);
  Buffer<Id> all(corners.size() + N * added.size());
  Id* to = std::transform(corners.begin(), corners.end(), all.begin(),
    [&](Id corner) { return Id(indexOf(idOf(corner))); });
  for (const IdCell<N>& cell : added)
  {
    to = std::transform(
      cell.begin(), cell.end(), to, [&](std::int64_t id) { return Id(indexOf(id)); });
  }
  corners = std::move(all);
  mine.Ghosts = fetchPoints(ranks, ghosts, mine.FirstIds, mine.Owned, mine.RowSize);
  mine.GhostIds = std::move(ghosts);
}

/// All ranks' values on the first rank, in the order of ranks; none on the others. Collective.
template <typename T>
Buffer<T> gatherValues(Communicator& ranks, Buffer<T> mine)
{
  const std::vector<Bytes> parts = ranks.gather(Bytes(std::move(mine)));
  std::size_t size = 0;
  for (const Bytes& part : parts)
  {
    size += part.size();
  }
  Buffer<T> all(size / sizeof(T));
  auto* to = reinterpret_cast<char*>(all.data());
  for (const Bytes& part : parts)
  {
    to = std::copy(part.begin(), part.end(), to);
  }
  return all;
}

/// All ranks' lists, concatenated on the first rank; an empty list on the others. Collective.
template <typename T>
std::vector<T> gatherList(Communicator& ranks, const std::vector<T>& mine)
{
  return concatenated(ranks.gather(mine));
}

/// Returns a function from the local indices of a mesh to global ids.
template <typename Mesh>
auto globalIds(const Mesh& mine)
{
  const auto own = std::int64_t(mine.Owned.size());
  return [&mine, own](std::int64_t index)
  {
    return index < own ? mine.Owned.GlobalIds[std::size_t(index)]
                       : mine.Ghosts.GlobalIds[std::size_t(index - own)];
  };
}

/// Moves owned points, duplicates and rejected points of a mesh to the first rank, but not its
/// cells, whose corners must be internal ids already. Collective.
template <typename Mesh>
void gatherPoints(Communicator& ranks, Mesh& mine)
{
  mine.Owned.Positions = gatherValues(ranks, std::move(mine.Owned.Positions));
  mine.Owned.GlobalIds = gatherValues(ranks, std::move(mine.Owned.GlobalIds));
  mine.Owned.Rows = gatherValues(ranks, std::move(mine.Owned.Rows));
  mine.Ghosts = {};
  mine.GhostIds.clear();
  mine.Duplicates = gatherList(ranks, mine.Duplicates);
  mine.Rejected = gatherList(ranks, mine.Rejected);
  std::fill(mine.FirstIds.begin() + 1, mine.FirstIds.end(), std::int64_t(mine.Owned.size()));
}

/// Sets the duplicates and rejected points of all ranks on the first one, sorted as in a run of one
/// process. Collective.
template <typename Mesh, typename Result>
void gatherDuplicatesAndRejected(Communicator& ranks, const Mesh& mine, Result& all)
{
  all.Duplicates = gatherList(ranks, mine.Duplicates);
  all.Rejected = gatherList(ranks, mine.Rejected);
  std::sort(all.Rejected.begin(), all.Rejected.end());
  std::sort(all.Duplicates.begin(), all.Duplicates.end());
}

} // namespace tipp

#endif
