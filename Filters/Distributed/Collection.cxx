// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/Collection.h"

#include "Distributed/RankArrays.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <cstring>
#include <map>
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
  std::vector<IdTriangle> home;
  for (const std::vector<IdTriangle>& received : swapArrays(ranks, sorted))
  {
    home.insert(home.end(), received.begin(), received.end());
  }
  return home;
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
  std::int64_t firstOwn, const Buffer<Point2>& places, const Tiling& leaves)
{
  std::vector<typename TriangleSink<Id>::FinalTriangle> local;
  local.reserve(triangles.size());
  const std::int64_t own = std::int64_t(places.size());
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
        const auto place = std::lower_bound(foreign.begin(), foreign.end(), triangle[i]);
        ids[i] = static_cast<Id>(own + (place - foreign.begin()));
      }
    }
    ids = TriangleSink<Id>::fromLowest(ids);
    local.push_back({ ids, leaves.locate(places[std::size_t(ids[0])]) });
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
  for (const std::vector<std::int64_t>& request : swapArrays(ranks, requests))
  {
    ByteWriter writer;
    for (const std::int64_t id : request)
    {
      const std::size_t at = std::size_t(id - firstOwn);
      if (at >= own.size())
      {
        throw std::runtime_error("Another rank asks for a point that is not here.");
      }
      writer.value(own.Places[at]);
      writer.value(own.GlobalIds[at]);
      writer.raw(own.Rows.data() + at * rowSize, rowSize);
    }
    answers.push_back(writer.take());
  }
  PointTuples fetched;
  fetched.Places = Buffer<Point2>(ids.size());
  fetched.GlobalIds = Buffer<PointId>(ids.size());
  fetched.Rows = Buffer<char>(ids.size() * rowSize);
  std::size_t at = 0;
  for (const Bytes& answer : ranks.allToAll(std::move(answers)))
  {
    for (ByteReader reader(answer); reader.left() > 0; ++at)
    {
      if (at == ids.size())
      {
        throw std::runtime_error("Another rank has sent more points than it was asked for.");
      }
      fetched.Places[at] = reader.value<Point2>();
      fetched.GlobalIds[at] = reader.value<PointId>();
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
    { localised<Id>(boundary, result.ForeignIds, firstOwn, points.Places, leaves) }, threads);
  if constexpr (sizeof(Id) == 4)
  {
    result.Ids32 = std::move(ids);
  }
  else
  {
    result.Ids64 = std::move(ids);
  }

  result.Owned.Places = std::move(points.Places);
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

} // namespace tipp
