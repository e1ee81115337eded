// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/TriangleExchange.h"

#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

namespace tipp
{
namespace
{

/// Sends each triangle to the rank that owns its vertex of lowest id. Ids are internal ids.
std::vector<IdTriangle> bringHome(Communicator& ranks, const std::vector<IdTriangle>& triangles,
  const std::vector<std::int64_t>& firstIds)
{
  const auto owner = [&firstIds](const IdTriangle& triangle)
  { return ownerOf(*std::min_element(triangle.begin(), triangle.end()), firstIds); };
  std::vector<std::size_t> counts(static_cast<std::size_t>(ranks.size()), 0);
  for (const IdTriangle& triangle : triangles)
  {
    ++counts[owner(triangle)];
  }
  std::vector<std::vector<IdTriangle>> sorted(counts.size());
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    sorted[rank].reserve(counts[rank]);
  }
  for (const IdTriangle& triangle : triangles)
  {
    sorted[owner(triangle)].push_back(triangle);
  }
  std::vector<IdTriangle> own;
  for (const std::vector<IdTriangle>& received : ranks.allToAll(sorted))
  {
    own.insert(own.end(), received.begin(), received.end());
  }
  return own;
}

std::vector<std::int64_t> foreignIds(
  const std::vector<IdTriangle>& triangles, std::int64_t firstOwn, std::int64_t endOwn)
{
  std::vector<std::int64_t> ids;
  for (const IdTriangle& triangle : triangles)
  {
    std::copy_if(triangle.begin(), triangle.end(), std::back_inserter(ids),
      [&](std::int64_t id) { return id < firstOwn || id >= endOwn; });
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// Converts internal ids to indices into Owned and, after these, Foreign.
template <typename Id>
std::vector<typename TriangleSink<Id>::FinalTriangle> localised(
  const std::vector<IdTriangle>& triangles, const std::vector<std::int64_t>& foreign,
  std::int64_t firstOwn, const Buffer<Point2>& positions, const Tiling& leaves)
{
  std::vector<typename TriangleSink<Id>::FinalTriangle> local;
  local.reserve(triangles.size());
  const std::int64_t own = std::int64_t(positions.size());
  for (const IdTriangle& triangle : triangles)
  {
    typename TriangleSink<Id>::Corners ids;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int64_t at = triangle[i] - firstOwn;
      if (at >= 0 && at < own)
      {
        ids[i] = static_cast<Id>(at);
      }
      else
      {
        const auto found = std::lower_bound(foreign.begin(), foreign.end(), triangle[i]);
        ids[i] = static_cast<Id>(own + (found - foreign.begin()));
      }
    }
    ids = TriangleSink<Id>::fromLowest(ids);
    local.push_back({ ids, leaves.locate(positions[std::size_t(ids[0])]) });
  }
  return local;
}

} // namespace

PointTuples fetchPoints(Communicator& ranks, const std::vector<std::int64_t>& ids,
  const std::vector<std::int64_t>& firstIds, const PointTuples& own, std::size_t rowSize)
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
  PointTuples fetched;
  fetched.Positions = Buffer<Point2>(ids.size());
  fetched.GlobalIds = Buffer<PointId>(ids.size());
  fetched.Rows = Buffer<char>(ids.size() * rowSize);
  std::size_t at = 0;
  for (const Bytes& answer : ranks.allToAll(std::move(answers)))
  {
    for (LoadArchive reader(answer); reader.left() > 0; ++at)
    {
      if (at == ids.size())
      {
        throw std::runtime_error("Another rank has sent more points than it was asked for.");
      }
      fetched.Positions[at] = reader.get<Point2>();
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

void preferLowestGlobalIds(
  PointTuples& points, std::int64_t firstId, std::vector<Duplicate>& duplicates)
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
  std::sort(duplicates.begin(), duplicates.end(),
    [](const Duplicate& a, const Duplicate& b) { return a.Point < b.Point; });
}

template <typename Id>
void collect(Communicator& ranks, OwnedPoints<Id>& points, const std::vector<IdTriangle>& kept,
  const std::vector<std::size_t>& interiorCounts, std::vector<Duplicate> duplicates,
  const Tiling& leaves, int threads, DistributedTriangulation& result)
{
  const std::size_t rowSize = result.RowSize;
  const std::int64_t firstOwn = points.FirstIds[std::size_t(ranks.rank())];
  result.FirstIds = points.FirstIds;
  const std::vector<IdTriangle> boundary = bringHome(ranks, kept, points.FirstIds);
  result.ForeignIds = foreignIds(boundary, firstOwn, firstOwn + std::int64_t(points.size()));

  TriangleSink<Id> sink(points.Buckets);
  for (std::size_t leaf = 0; leaf < interiorCounts.size(); ++leaf)
  {
    sink.setInteriorCount(static_cast<PartitionIndex>(leaf), interiorCounts[leaf]);
  }
  Buffer<Id> ids = sink.assemble(
    { localised<Id>(boundary, result.ForeignIds, firstOwn, points.Positions, leaves) }, threads);
  if constexpr (sizeof(Id) == 4)
  {
    result.Ids32 = std::move(ids);
  }
  else
  {
    result.Ids64 = std::move(ids);
  }

  result.Owned.Positions = std::move(points.Positions);
  result.Owned.GlobalIds = std::move(points.GlobalIds);
  result.Owned.Rows = std::move(points.Rows);
  preferLowestGlobalIds(result.Owned, firstOwn, duplicates);
  result.Duplicates = std::move(duplicates);
  result.Foreign = fetchPoints(ranks, result.ForeignIds, points.FirstIds, result.Owned, rowSize);
}

template void collect(Communicator&, OwnedPoints<std::int32_t>&, const std::vector<IdTriangle>&,
  const std::vector<std::size_t>&, std::vector<Duplicate>, const Tiling&, int,
  DistributedTriangulation&);
template void collect(Communicator&, OwnedPoints<std::int64_t>&, const std::vector<IdTriangle>&,
  const std::vector<std::size_t>&, std::vector<Duplicate>, const Tiling&, int,
  DistributedTriangulation&);

namespace
{

/// For each vertex that this rank shares, by internal id, the other ranks with triangles at it.
using Users = std::map<std::int64_t, std::vector<std::int32_t>>;

struct SharedVertex
{
  std::int64_t Id;
  std::int64_t User;
};

/// Sends the points used to their owners, and each owner sends the using ranks to all of them.
/// Collective.
Users findUsers(Communicator& ranks, const DistributedTriangulation& mine,
  const std::vector<IdTriangle>& triangles)
{
  const std::int64_t firstOwn = mine.FirstIds[std::size_t(ranks.rank())];
  std::vector<std::vector<std::int64_t>> asked(std::size_t(ranks.size()));
  for (const std::int64_t id : mine.ForeignIds)
  {
    asked[ownerOf(id, mine.FirstIds)].push_back(id);
  }
  std::vector<char> used(mine.Owned.size(), 0);
  for (const IdTriangle& triangle : triangles)
  {
    for (const std::int64_t id : triangle)
    {
      const std::size_t at = std::size_t(id - firstOwn);
      if (at < used.size())
      {
        used[at] = 1;
      }
    }
  }
  Users ofOwn;
  const auto requests = ranks.allToAll(asked);
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
  std::vector<std::vector<SharedVertex>> told(std::size_t(ranks.size()));
  for (const auto& [id, users] : ofOwn)
  {
    for (const std::int32_t user : users)
    {
      for (const std::int32_t other : users)
      {
        if (other != user)
        {
          told[std::size_t(user)].push_back({ id, other });
        }
      }
    }
  }
  Users users;
  for (const auto& part : ranks.allToAll(told))
  {
    for (const SharedVertex& shared : part)
    {
      users[shared.Id].push_back(std::int32_t(shared.User));
    }
  }
  return users;
}

} // namespace

namespace
{

/// Returns the internal id of an index among owned and then foreign points.
auto internalIds(const DistributedTriangulation& mine, int rank)
{
  const std::int64_t firstOwn = mine.FirstIds[std::size_t(rank)];
  const std::int64_t own = std::int64_t(mine.Owned.size());
  return [&mine, firstOwn, own](std::int64_t index)
  { return index < own ? firstOwn + index : mine.ForeignIds[std::size_t(index - own)]; };
}

} // namespace

std::vector<IdTriangle> trianglesByIds(const DistributedTriangulation& mine, int rank)
{
  const auto idOf = internalIds(mine, rank);
  std::vector<IdTriangle> triangles;
  triangles.reserve(mine.triangleCount());
  const auto add = [&](const auto& ids)
  {
    for (std::size_t i = 0; i < ids.size(); i += 3)
    {
      triangles.push_back({ idOf(ids[i]), idOf(ids[i + 1]), idOf(ids[i + 2]) });
    }
  };
  add(mine.Ids32);
  add(mine.Ids64);
  return triangles;
}

GhostTriangles fetchGhosts(Communicator& ranks, const DistributedTriangulation& mine)
{
  struct Sent
  {
    IdTriangle Corners;
    std::int64_t Number;
  };
  const std::vector<IdTriangle> triangles = trianglesByIds(mine, ranks.rank());
  const Users users = findUsers(ranks, mine, triangles);
  std::vector<std::vector<Sent>> toRanks(std::size_t(ranks.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    std::set<std::int32_t> to;
    for (const std::int64_t id : triangles[t])
    {
      const auto shared = users.find(id);
      if (shared != users.end())
      {
        to.insert(shared->second.begin(), shared->second.end());
      }
    }
    for (const std::int32_t rank : to)
    {
      toRanks[std::size_t(rank)].push_back({ triangles[t], mine.FirstTriangle + std::int64_t(t) });
    }
  }
  GhostTriangles ghosts;
  const std::int64_t firstOwn = mine.FirstIds[std::size_t(ranks.rank())];
  const std::int64_t endOwn = mine.FirstIds[std::size_t(ranks.rank()) + 1];
  for (const auto& part : ranks.allToAll(toRanks))
  {
    for (const Sent& sent : part)
    {
      ghosts.Triangles.push_back(sent.Corners);
      ghosts.Numbers.push_back(sent.Number);
      for (const std::int64_t id : sent.Corners)
      {
        if ((id < firstOwn || id >= endOwn) &&
          !std::binary_search(mine.ForeignIds.begin(), mine.ForeignIds.end(), id))
        {
          ghosts.PointIds.push_back(id);
        }
      }
    }
  }
  std::sort(ghosts.PointIds.begin(), ghosts.PointIds.end());
  ghosts.PointIds.erase(
    std::unique(ghosts.PointIds.begin(), ghosts.PointIds.end()), ghosts.PointIds.end());
  ghosts.Points = fetchPoints(ranks, ghosts.PointIds, mine.FirstIds, mine.Owned, mine.RowSize);
  return ghosts;
}

namespace
{

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

/// The same of triangles, with idOf(index) for each corner.
template <typename IdOf>
Buffer<std::int64_t> gatherCorners(
  Communicator& ranks, const DistributedTriangulation& mine, const IdOf& idOf)
{
  Buffer<std::int64_t> ids(3 * mine.triangleCount());
  std::int64_t* to = ids.data();
  const auto fill = [&](const auto& indices)
  {
    for (const std::int64_t index : indices)
    {
      *to++ = idOf(index);
    }
  };
  fill(mine.Ids32);
  fill(mine.Ids64);
  return gatherValues(ranks, std::move(ids));
}

template <typename T>
std::vector<T> gatherList(Communicator& ranks, const std::vector<T>& mine)
{
  std::vector<T> all;
  for (const std::vector<T>& part : ranks.gather(mine))
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

} // namespace

DistributedTriangulation gatherOnFirst(Communicator& ranks, DistributedTriangulation mine)
{
  mine.Ids64 = gatherCorners(ranks, mine, internalIds(mine, ranks.rank()));
  mine.Ids32 = {};
  mine.Owned.Positions = gatherValues(ranks, std::move(mine.Owned.Positions));
  mine.Owned.GlobalIds = gatherValues(ranks, std::move(mine.Owned.GlobalIds));
  mine.Owned.Rows = gatherValues(ranks, std::move(mine.Owned.Rows));
  mine.Foreign = {};
  mine.ForeignIds.clear();
  mine.Duplicates = gatherList(ranks, mine.Duplicates);
  mine.Rejected = gatherList(ranks, mine.Rejected);
  std::fill(mine.FirstIds.begin() + 1, mine.FirstIds.end(), std::int64_t(mine.Owned.size()));
  mine.FirstTriangle = ranks.isFirst() ? 0 : mine.AllTriangles;
  return mine;
}

Triangulation gatherTriangles(Communicator& ranks, const DistributedTriangulation& mine)
{
  const std::int64_t own = std::int64_t(mine.Owned.size());
  Triangulation result;
  result.Ids64 = gatherCorners(ranks, mine,
    [&](std::int64_t index)
    {
      return index < own ? mine.Owned.GlobalIds[std::size_t(index)]
                         : mine.Foreign.GlobalIds[std::size_t(index - own)];
    });
  result.Duplicates = gatherList(ranks, mine.Duplicates);
  result.Rejected = gatherList(ranks, mine.Rejected);
  std::sort(result.Duplicates.begin(), result.Duplicates.end(),
    [](const Duplicate& a, const Duplicate& b) { return a.Point < b.Point; });
  return result;
}

} // namespace tipp
