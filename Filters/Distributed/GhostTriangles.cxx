// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/GhostTriangles.h"

#include "Distributed/Collection.h"
#include "Distributed/RankArrays.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace tipp
{
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
  const auto requests = swapArrays(ranks, asked);
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
  for (const auto& part : swapArrays(ranks, told))
  {
    for (const SharedVertex& shared : part)
    {
      users[shared.Id].push_back(std::int32_t(shared.User));
    }
  }
  return users;
}

} // namespace

std::vector<IdTriangle> trianglesByIds(const DistributedTriangulation& mine, int rank)
{
  const std::int64_t firstOwn = mine.FirstIds[std::size_t(rank)];
  const std::int64_t own = std::int64_t(mine.Owned.size());
  const auto idOf = [&](std::int64_t place)
  { return place < own ? firstOwn + place : mine.ForeignIds[std::size_t(place - own)]; };
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
  for (const auto& part : swapArrays(ranks, toRanks))
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

DistributedTriangulation gatherOnFirst(Communicator& ranks, DistributedTriangulation mine)
{
  ByteWriter writer;
  writer.array(trianglesByIds(mine, ranks.rank()));
  writer.array(mine.Owned.Places.data(), mine.Owned.Places.size());
  writer.array(mine.Owned.GlobalIds.data(), mine.Owned.GlobalIds.size());
  writer.array(mine.Owned.Rows.data(), mine.Owned.Rows.size());
  writer.array(mine.Duplicates);
  writer.array(mine.Rejected);
  const std::vector<Bytes> all = ranks.gather(writer.take());
  const bool first = ranks.rank() == 0;
  const std::size_t points = first ? std::size_t(mine.FirstIds.back()) : 0;
  mine.Ids32 = {};
  mine.Ids64 = Buffer<std::int64_t>(first ? std::size_t(3 * mine.AllTriangles) : 0);
  mine.Owned.Places = Buffer<Point2>(points);
  mine.Owned.GlobalIds = Buffer<PointId>(points);
  mine.Owned.Rows = Buffer<char>(points * mine.RowSize);
  mine.Foreign = {};
  mine.ForeignIds.clear();
  mine.Duplicates.clear();
  mine.Rejected.clear();
  std::fill(mine.FirstIds.begin() + 1, mine.FirstIds.end(), std::int64_t(points));
  std::int64_t* id = mine.Ids64.data();
  std::size_t at = 0;
  for (const Bytes& part : all)
  {
    ByteReader reader(part);
    for (const IdTriangle& triangle : reader.array<IdTriangle>())
    {
      id = std::copy(triangle.begin(), triangle.end(), id);
    }
    const auto places = reader.array<Point2>();
    const auto ids = reader.array<PointId>();
    const auto rows = reader.array<char>();
    std::copy(places.begin(), places.end(), mine.Owned.Places.data() + at);
    std::copy(ids.begin(), ids.end(), mine.Owned.GlobalIds.data() + at);
    std::copy(rows.begin(), rows.end(), mine.Owned.Rows.data() + at * mine.RowSize);
    at += places.size();
    const auto duplicates = reader.array<Duplicate>();
    const auto rejected = reader.array<PointId>();
    mine.Duplicates.insert(mine.Duplicates.end(), duplicates.begin(), duplicates.end());
    mine.Rejected.insert(mine.Rejected.end(), rejected.begin(), rejected.end());
  }
  mine.FirstTriangle = first ? 0 : mine.AllTriangles;
  return mine;
}

} // namespace tipp
