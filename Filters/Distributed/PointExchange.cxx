// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/PointExchange.h"

#include "Triangulation/PartitionSizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace tipp
{
namespace
{

constexpr std::uint32_t NoLeaf = std::numeric_limits<std::uint32_t>::max();

std::size_t partBegin(std::size_t n, int part, int parts)
{
  return n / std::size_t(parts) * std::size_t(part) +
    std::min(n % std::size_t(parts), std::size_t(part));
}

/// Leaves of many points at a time, so that their searches overlap.
void label(PointsView points, std::size_t begin, std::size_t end, const Tiling& leaves,
  std::uint32_t* labels, std::vector<std::size_t>& counts)
{
  constexpr std::size_t batch = 64;
  std::array<Point2, batch> places;
  for (std::size_t at = begin; at < end; at += batch)
  {
    const std::size_t size = std::min(batch, end - at);
    points.forEach(at, at + size, [&](std::size_t i, Point2 p) { places[i - at] = p; });
    leaves.locate(places.data(), size, labels + at);
    for (std::size_t i = 0; i < size; ++i)
    {
      std::uint32_t& leaf = labels[at + i];
      if (!isFinite(places[i]))
      {
        leaf = NoLeaf;
        continue;
      }
      ++counts[leaf];
    }
  }
}

/// Where the parts of a message of so many points are: places, ids and rows, after the counts.
struct Layout
{
  Layout(std::size_t leaves, std::size_t points, std::size_t rowSize)
    : Places(leaves * sizeof(std::uint64_t))
    , Ids(this->Places + points * sizeof(Point2))
    , Rows(this->Ids + points * sizeof(PointId))
    , End(this->Rows + points * rowSize)
  {
  }
  std::size_t Places;
  std::size_t Ids;
  std::size_t Rows;
  std::size_t End;
};

std::vector<std::size_t> leavesOf(int rank, const std::vector<std::int32_t>& owners)
{
  std::vector<std::size_t> leaves;
  for (std::size_t leaf = 0; leaf < owners.size(); ++leaf)
  {
    if (owners[leaf] == rank)
    {
      leaves.push_back(leaf);
    }
  }
  return leaves;
}

void requireSize(std::size_t actual, std::size_t expected)
{
  if (actual != expected)
  {
    throw std::runtime_error("Points from another rank are damaged: their message has " +
      std::to_string(actual) + " bytes instead of " + std::to_string(expected) + ".");
  }
}

} // namespace

PointExchange::PointExchange(const RankPoints& points, const Tiling& leaves, int threads)
  : Input(points)
  , Leaves(static_cast<std::size_t>(leaves.size()))
  , Threads(threads)
  , Labels(points.Points.size())
  , Counts(static_cast<std::size_t>(threads), std::vector<std::size_t>(this->Leaves, 0))
{
  const std::size_t size = points.Points.size();
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (int part = 0; part < threads; ++part)
  {
    label(points.Points, partBegin(size, part, threads), partBegin(size, part + 1, threads), leaves,
      this->Labels.data(), this->Counts[std::size_t(part)]);
  }
}

std::vector<std::int64_t> PointExchange::counts() const
{
  std::vector<std::int64_t> counts(this->Leaves, 0);
  for (const std::vector<std::size_t>& part : this->Counts)
  {
    for (std::size_t leaf = 0; leaf < this->Leaves; ++leaf)
    {
      counts[leaf] += std::int64_t(part[leaf]);
    }
  }
  return counts;
}

/// A message for each rank: the number of points in each of its leaves, then the points leaf by
/// leaf.
std::vector<Bytes> PointExchange::pack(int ranks, const std::vector<std::int32_t>& owners) const
{
  const std::vector<std::int64_t> leafCounts = this->counts();
  const std::size_t rowSize = this->Input.RowSize;
  std::vector<std::size_t> leaves(std::size_t(ranks), 0);
  std::vector<std::size_t> points(std::size_t(ranks), 0);
  std::vector<std::size_t> begins(this->Leaves); // of each leaf among its owner's points
  for (std::size_t leaf = 0; leaf < this->Leaves; ++leaf)
  {
    const std::size_t owner = std::size_t(owners[leaf]);
    begins[leaf] = points[owner];
    ++leaves[owner];
    points[owner] += std::size_t(leafCounts[leaf]);
  }
  std::vector<Bytes> messages;
  std::vector<Layout> layouts;
  for (std::size_t rank = 0; rank < std::size_t(ranks); ++rank)
  {
    layouts.emplace_back(leaves[rank], points[rank], rowSize);
    messages.emplace_back(layouts.back().End);
    leaves[rank] = 0;
  }
  for (std::size_t leaf = 0; leaf < this->Leaves; ++leaf)
  {
    const std::size_t owner = std::size_t(owners[leaf]);
    const std::uint64_t count = std::uint64_t(leafCounts[leaf]);
    std::memcpy(messages[owner].data() + leaves[owner]++ * sizeof(count), &count, sizeof(count));
  }
#pragma omp parallel for num_threads(this->Threads) schedule(static, 1)
  for (int part = 0; part < this->Threads; ++part)
  {
    struct Cursor
    {
      Point2* Place;
      PointId* Id;
      char* Row;
    };
    std::vector<Cursor> cursors(this->Leaves);
    for (std::size_t leaf = 0; leaf < this->Leaves; ++leaf)
    {
      std::size_t at = begins[leaf];
      for (int before = 0; before < part; ++before)
      {
        at += this->Counts[std::size_t(before)][leaf];
      }
      const Layout& layout = layouts[std::size_t(owners[leaf])];
      char* const message = messages[std::size_t(owners[leaf])].data();
      cursors[leaf] = { reinterpret_cast<Point2*>(message + layout.Places) + at,
        reinterpret_cast<PointId*>(message + layout.Ids) + at,
        message + layout.Rows + at * rowSize };
    }
    const std::size_t size = this->Input.Points.size();
    this->Input.Points.forEach(partBegin(size, part, this->Threads),
      partBegin(size, part + 1, this->Threads),
      [&](std::size_t i, Point2 p)
      {
        if (this->Labels[i] == NoLeaf)
        {
          return;
        }
        Cursor& cursor = cursors[this->Labels[i]];
        *cursor.Place++ = p;
        *cursor.Id++ = this->Input.globalId(i);
        if (rowSize > 0)
        {
          this->Input.PackRow(i, cursor.Row);
          cursor.Row += rowSize;
        }
      });
  }
  return messages;
}

template <typename Id>
OwnedPoints<Id> PointExchange::exchange(
  Postbox& ranks, const std::vector<std::int32_t>& owners) const
{
  const std::size_t rowSize = this->Input.RowSize;
  std::vector<Bytes> received = ranks.allToAll(this->pack(ranks.size(), owners));
  const std::vector<std::size_t> mine = leavesOf(ranks.rank(), owners);
  std::vector<std::size_t> sizes(this->Leaves, 0);
  std::vector<Layout> layouts;
  std::size_t total = 0;
  for (const Bytes& message : received)
  {
    if (message.size() < mine.size() * sizeof(std::uint64_t))
    {
      requireSize(message.size(), mine.size() * sizeof(std::uint64_t));
    }
    const auto* counts = reinterpret_cast<const std::uint64_t*>(message.data());
    std::size_t points = 0;
    for (std::size_t i = 0; i < mine.size(); ++i)
    {
      sizes[mine[i]] += counts[i];
      points += counts[i];
    }
    layouts.emplace_back(mine.size(), points, rowSize);
    requireSize(message.size(), layouts.back().End);
    total += points;
  }

  OwnedPoints<Id> owned;
  std::vector<std::size_t> starts = { 0 };
  for (const std::size_t size : sizes)
  {
    requireFitsKernel(size);
    starts.push_back(starts.back() + size);
  }
  // Triangles with other ranks' points come on top of two a point; memory never touched is free.
  owned.Buckets = PointBuckets<Id>(starts, total / 8);
  owned.Places = Buffer<Point2>(total);
  owned.GlobalIds = Buffer<PointId>(total);
  owned.Rows = Buffer<char>(total * rowSize);
  std::vector<std::size_t> taken(received.size(), 0); // of each message's points
  for (std::size_t i = 0; i < mine.size(); ++i)
  {
    const std::size_t leaf = mine[i];
    const PartitionIndex bucket = static_cast<PartitionIndex>(leaf);
    std::size_t at = starts[leaf];
    for (std::size_t source = 0; source < received.size(); ++source)
    {
      const char* message = received[source].data();
      const std::size_t count = reinterpret_cast<const std::uint64_t*>(message)[i];
      const std::size_t from = taken[source];
      const Layout& layout = layouts[source];
      const auto copy = [&](void* to, std::size_t begin, std::size_t size)
      {
        if (count * size > 0)
        {
          std::memcpy(to, message + begin + from * size, count * size);
        }
      };
      copy(owned.Buckets.points(bucket) + (at - starts[leaf]), layout.Places, sizeof(Point2));
      copy(owned.Places.data() + at, layout.Places, sizeof(Point2));
      copy(owned.GlobalIds.data() + at, layout.Ids, sizeof(PointId));
      copy(owned.Rows.data() + at * rowSize, layout.Rows, rowSize);
      taken[source] += count;
      at += count;
    }
    Id* const ids = owned.Buckets.ids(bucket);
    for (std::size_t k = 0; k < sizes[leaf]; ++k)
    {
      ids[k] = static_cast<Id>(starts[leaf] + k);
    }
  }
  std::vector<std::int64_t> counts(std::size_t(ranks.size()), 0);
  counts[std::size_t(ranks.rank())] = std::int64_t(total);
  ranks.sum(counts);
  owned.FirstIds = { 0 };
  for (const std::int64_t count : counts)
  {
    owned.FirstIds.push_back(owned.FirstIds.back() + count);
  }
  return owned;
}

template OwnedPoints<std::int32_t> PointExchange::exchange(
  Postbox&, const std::vector<std::int32_t>&) const;
template OwnedPoints<std::int64_t> PointExchange::exchange(
  Postbox&, const std::vector<std::int32_t>&) const;

} // namespace tipp
