// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/PointExchange.h"

#include "Parallel/ParallelFor.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>

namespace tipp
{
namespace
{

void requireSize(std::size_t actual, std::size_t expected)
{
  if (actual != expected)
  {
    throw std::runtime_error("Points from another rank are damaged: their message has " +
      std::to_string(actual) + " bytes instead of " + std::to_string(expected) + ".");
  }
}

/// Sends the counts to the leaves' owners; returns by rank the counts of this rank's leaves.
/// Collective.
std::vector<std::vector<std::uint64_t>> exchangeCounts(Communicator& ranks,
  const std::vector<std::int32_t>& owners, const std::vector<std::int64_t>& counts)
{
  std::vector<std::vector<std::uint64_t>> countsOf(static_cast<std::size_t>(ranks.size()));
  for (std::size_t leaf = 0; leaf < owners.size(); ++leaf)
  {
    countsOf[std::size_t(owners[leaf])].push_back(std::uint64_t(counts[leaf]));
  }
  const std::size_t leaves = countsOf[std::size_t(ranks.rank())].size();
  std::vector<std::vector<std::uint64_t>> received = ranks.allToAll(countsOf);
  for (const std::vector<std::uint64_t>& of : received)
  {
    requireSize(of.size() * sizeof(std::uint64_t), leaves * sizeof(std::uint64_t));
  }
  return received;
}

} // namespace

PointArrays::PointArrays(char* memory, std::size_t points)
  : Positions(reinterpret_cast<Point2*>(memory))
  , Ids(reinterpret_cast<PointId*>(this->Positions + points))
  , Rows(reinterpret_cast<char*>(this->Ids + points))
{
}

std::size_t PointArrays::bytes(std::size_t points, std::size_t rowSize)
{
  return points * (sizeof(Point2) + sizeof(PointId) + rowSize);
}

PointLayout::PointLayout(Communicator& ranks, const std::vector<std::int32_t>& owners,
  const std::vector<std::int64_t>& counts)
  : Rank(ranks.rank())
  , Counts(exchangeCounts(ranks, owners, counts))
  , Firsts(this->Counts.size())
  , Starts(1, 0)
{
  std::size_t own = 0;
  for (const std::int32_t owner : owners)
  {
    std::size_t end = this->Starts.back();
    if (owner == this->Rank)
    {
      for (std::size_t source = 0; source < this->Counts.size(); ++source)
      {
        this->Firsts[source].push_back(end);
        end += this->Counts[source][own];
      }
      ++own;
    }
    requireFitsKernel(end - this->Starts.back());
    this->Starts.push_back(end);
  }
}

PointReceiver::PointReceiver(const PointLayout& layout, std::size_t source,
  const PointArrays& destination, std::size_t rowSize)
{
  const std::vector<std::uint64_t>& counts = layout.Counts[source];
  const std::vector<std::size_t>& firsts = layout.Firsts[source];
  const auto add = [&](char* array, std::size_t itemSize)
  {
    for (std::size_t leaf = 0; leaf < counts.size(); ++leaf)
    {
      if (counts[leaf] > 0 && itemSize > 0)
      {
        this->Left.push_back({ array + firsts[leaf] * itemSize, counts[leaf] * itemSize });
      }
    }
  };
  add(reinterpret_cast<char*>(destination.Positions), sizeof(Point2));
  add(reinterpret_cast<char*>(destination.Ids), sizeof(PointId));
  add(destination.Rows, rowSize);
  std::reverse(this->Left.begin(), this->Left.end());
}

void PointReceiver::take(const char* part, std::size_t size)
{
  while (size > 0)
  {
    if (this->Left.empty())
    {
      throw std::runtime_error(
        "Points from another rank are damaged: they are more than it announced.");
    }
    Range& range = this->Left.back();
    const std::size_t taken = std::min(size, range.Size);
    std::memcpy(range.To, part, taken);
    part += taken;
    size -= taken;
    range = { range.To + taken, range.Size - taken };
    if (range.Size == 0)
    {
      this->Left.pop_back();
    }
  }
}

void PointReceiver::requireComplete() const
{
  if (!this->Left.empty())
  {
    throw std::runtime_error(
      "Points from another rank are damaged: they are fewer than it announced.");
  }
}

namespace
{

std::size_t partBegin(std::size_t n, int part, int parts)
{
  return n / std::size_t(parts) * std::size_t(part) +
    std::min(n % std::size_t(parts), std::size_t(part));
}

/// Commits the pages of memory that will be used completely.
template <typename Item>
void populate(Buffer<Item>& memory, int threads)
{
  const auto populatePart = [&](std::int64_t part)
  {
    const std::size_t begin = partBegin(memory.size(), int(part), threads);
    const std::size_t end = partBegin(memory.size(), int(part) + 1, threads);
    populatePages(memory.data() + begin, (end - begin) * sizeof(Item));
  };
  parallelFor(threads, threads, populatePart);
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
  populate(this->Labels, threads);
  const PartitionFinder finder(leaves);
  const auto labelPart = [&](std::int64_t part)
  {
    finder.label(points.Points, partBegin(size, int(part), threads),
      partBegin(size, int(part) + 1, threads), this->Labels.data(),
      this->Counts[std::size_t(part)]);
  };
  parallelFor(threads, threads, labelPart);
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

void PointExchange::scatter(
  const std::vector<PointArrays>& to, const std::vector<std::size_t>& begins) const
{
  const std::size_t rowSize = this->Input.RowSize;
  const auto scatterPart = [&](std::int64_t part)
  {
    std::vector<PointArrays> cursors = to;
    for (std::size_t leaf = 0; leaf < this->Leaves; ++leaf)
    {
      std::size_t at = begins[leaf];
      for (std::int64_t before = 0; before < part; ++before)
      {
        at += this->Counts[std::size_t(before)][leaf];
      }
      PointArrays& cursor = cursors[leaf];
      cursor = { cursor.Positions + at, cursor.Ids + at, cursor.Rows + at * rowSize };
    }
    const std::size_t size = this->Input.Points.size();
    this->Input.Points.forEach(partBegin(size, int(part), this->Threads),
      partBegin(size, int(part) + 1, this->Threads),
      [&](std::size_t i, Point2 p)
      {
        if (this->Labels[i] == PartitionFinder::None)
        {
          return;
        }
        PointArrays& cursor = cursors[this->Labels[i]];
        *cursor.Positions++ = p;
        *cursor.Ids++ = this->Input.globalId(i);
        if (rowSize > 0)
        {
          this->Input.PackRow(i, cursor.Rows);
          cursor.Rows += rowSize;
        }
      });
  };
  parallelFor(this->Threads, this->Threads, scatterPart);
}

PointExchange::Packing PointExchange::planPacking(
  const std::vector<std::int32_t>& owners, const PointLayout& layout) const
{
  const std::vector<std::int64_t> counts = this->counts();
  Packing packing;
  packing.Sizes.assign(layout.Counts.size(), 0);
  packing.Begins.resize(this->Leaves);
  const std::size_t me = std::size_t(layout.Rank);
  for (std::size_t leaf = 0, own = 0; leaf < this->Leaves; ++leaf)
  {
    const std::size_t owner = std::size_t(owners[leaf]);
    packing.Begins[leaf] = owner == me ? layout.Firsts[me][own++] : packing.Sizes[owner];
    packing.Sizes[owner] += std::size_t(counts[leaf]);
  }
  for (std::size_t to = 0; to < packing.Sizes.size(); ++to)
  {
    constexpr std::size_t alignment = alignof(std::max_align_t);
    const std::size_t size =
      to == me ? 0 : PointArrays::bytes(packing.Sizes[to], this->Input.RowSize);
    packing.Messages.push_back({ packing.Size, size });
    packing.Size += (size + alignment - 1) / alignment * alignment;
  }
  return packing;
}

/// Copies this rank's own points to their positions, and the others into messages.
void PointExchange::pack(const std::vector<std::int32_t>& owners, const Packing& packing,
  const PointArrays& destination, char* messages) const
{
  std::vector<PointArrays> arrays;
  for (std::size_t to = 0; to < packing.Sizes.size(); ++to)
  {
    const Communicator::ByteRange& message = packing.Messages[to];
    arrays.push_back(
      message.Size == 0 ? destination : PointArrays(messages + message.Begin, packing.Sizes[to]));
  }
  std::vector<PointArrays> arraysOfLeaves;
  arraysOfLeaves.reserve(owners.size());
  for (const std::int32_t owner : owners)
  {
    arraysOfLeaves.push_back(arrays[std::size_t(owner)]);
  }
  this->scatter(arraysOfLeaves, packing.Begins);
}

template <typename Id>
OwnedPoints<Id> PointExchange::exchange(
  Communicator& ranks, const std::vector<std::int32_t>& owners) const
{
  const std::size_t rowSize = this->Input.RowSize;
  const PointLayout layout(ranks, owners, this->counts());
  const std::size_t total = layout.Starts.back();
  OwnedPoints<Id> owned;
  owned.Positions = Buffer<Point2>(total);
  owned.GlobalIds = Buffer<PointId>(total);
  owned.Rows = Buffer<char>(total * rowSize);
  populate(owned.Positions, this->Threads);
  populate(owned.GlobalIds, this->Threads);
  const PointArrays destination(owned.Positions.data(), owned.GlobalIds.data(), owned.Rows.data());
  // Triangles with other ranks' points are in addition to two per point. Untouched pages are not
  // committed.
  owned.Buckets = PointBuckets<Id>(layout.Starts, destination.Positions, total / 8);

  const Packing packing = this->planPacking(owners, layout);
  parallelFor(this->Threads, this->Threads,
    [&](std::int64_t part) { owned.Buckets.populate(int(part), this->Threads); });
  // Messages are packed into the triangles' memory if they fit: fresh memory takes time.
  Bytes messages(owned.Buckets.release());
  const bool fits = packing.Size <= messages.size();
  if (!fits)
  {
    owned.Buckets.takeBack(Buffer<Id>(std::move(messages)));
    messages = Bytes(packing.Size);
  }
  this->pack(owners, packing, destination, messages.data());
  std::vector<PointReceiver> receivers;
  for (std::size_t source = 0; source < layout.Counts.size(); ++source)
  {
    receivers.emplace_back(layout, source, destination, rowSize);
  }
  messages = ranks.allToAllInParts(std::move(messages), packing.Messages,
    [&receivers](int from, const char* part, std::size_t size)
    { receivers[std::size_t(from)].take(part, size); });
  for (std::size_t source = 0; source < receivers.size(); ++source)
  {
    if (source != std::size_t(ranks.rank()))
    {
      receivers[source].requireComplete();
    }
  }
  if (fits)
  {
    owned.Buckets.takeBack(Buffer<Id>(std::move(messages)));
  }
  owned.FirstIds = firstIndices(ranks, std::int64_t(total));
  return owned;
}

template OwnedPoints<std::int32_t> PointExchange::exchange(
  Communicator&, const std::vector<std::int32_t>&) const;
template OwnedPoints<std::int64_t> PointExchange::exchange(
  Communicator&, const std::vector<std::int32_t>&) const;

} // namespace tipp
