// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed3D/PointExchange3.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The arrays of a message's points: positions, ids and rows.
struct MessageArrays
{
  MessageArrays(char* memory, std::size_t points)
    : Positions(memory)
    , Ids(memory + points * sizeof(Point3))
    , Rows(this->Ids + points * sizeof(PointId))
  {
  }

  char* Positions;
  char* Ids;
  char* Rows;
};

/// Returns the rank that owns each point; -1 if it is not finite.
Buffer<std::int32_t> findOwners(
  const RankPoints3& points, const Tiling3& tiling, double factor, int threads)
{
  constexpr std::int64_t chunk = 1 << 16;
  Buffer<std::int32_t> owners(points.Count);
  forChunks(std::int64_t(points.Count), chunk, threadCount(threads), {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
      {
        const Point3& p = points.Points[i];
        owners[i] = !isFinite(p)
          ? -1
          : tiling.groupOf(tiling.locate({ p.x * factor, p.y * factor, p.z * factor }));
      }
    });
  return owners;
}

std::vector<Bytes> packPoints(
  const RankPoints3& points, const Buffer<std::int32_t>& owners, std::size_t ranks, double factor)
{
  std::vector<std::size_t> counts(ranks, 0);
  for (const std::int32_t owner : owners)
  {
    owner < 0 ? void() : void(++counts[std::size_t(owner)]);
  }
  std::vector<Bytes> messages;
  std::vector<MessageArrays> arrays;
  for (const std::size_t count : counts)
  {
    messages.emplace_back(count * (sizeof(Point3) + sizeof(PointId) + points.RowSize));
    arrays.emplace_back(messages.back().data(), count);
  }
  for (std::size_t i = 0; i < points.Count; ++i)
  {
    if (owners[i] < 0)
    {
      continue;
    }
    MessageArrays& to = arrays[std::size_t(owners[i])];
    const Point3& p = points.Points[i];
    const Point3 scaled{ p.x * factor, p.y * factor, p.z * factor };
    const PointId id = points.globalId(i);
    std::memcpy(
      std::exchange(to.Positions, to.Positions + sizeof(scaled)), &scaled, sizeof(scaled));
    std::memcpy(std::exchange(to.Ids, to.Ids + sizeof(id)), &id, sizeof(id));
    if (points.RowSize > 0)
    {
      points.PackRow(i, std::exchange(to.Rows, to.Rows + points.RowSize));
    }
  }
  return messages;
}

} // namespace

PointTuples3 exchangePoints(
  Communicator& ranks, const RankPoints3& points, const Tiling3& tiling, double factor, int threads)
{
  const Buffer<std::int32_t> owners = findOwners(points, tiling, factor, threads);
  std::vector<Bytes> received =
    ranks.allToAll(packPoints(points, owners, std::size_t(ranks.size()), factor));
  const std::size_t record = sizeof(Point3) + sizeof(PointId) + points.RowSize;
  std::size_t count = 0;
  for (const Bytes& message : received)
  {
    if (message.size() % record != 0)
    {
      throw std::runtime_error("Points from another rank are damaged: a point ends early.");
    }
    count += message.size() / record;
  }
  PointTuples3 owned;
  owned.Positions = Buffer<Point3>(count);
  owned.GlobalIds = Buffer<PointId>(count);
  owned.Rows = Buffer<char>(count * points.RowSize);
  std::size_t at = 0;
  for (Bytes& message : received)
  {
    const std::size_t part = message.size() / record;
    const MessageArrays from(message.data(), part);
    const auto copy = [](const char* values, std::size_t size, void* to)
    { size > 0 ? void(std::memcpy(to, values, size)) : void(); };
    copy(from.Positions, part * sizeof(Point3), owned.Positions.data() + at);
    copy(from.Ids, part * sizeof(PointId), owned.GlobalIds.data() + at);
    copy(from.Rows, part * points.RowSize, owned.Rows.data() + at * points.RowSize);
    at += part;
    message = Bytes();
  }
  return owned;
}

} // namespace tipp
