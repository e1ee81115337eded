// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/PointExchange.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>

namespace tipp
{
namespace
{

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
    if (of.size() != leaves)
    {
      throw std::runtime_error("Points from another rank are damaged: there are counts for " +
        std::to_string(of.size()) + " partitions instead of " + std::to_string(leaves) + ".");
    }
  }
  return received;
}

} // namespace

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
    this->Starts.push_back(end);
  }
}

void PointReceiver::add(
  const PointLayout& layout, std::size_t source, void* array, std::size_t itemSize)
{
  const std::vector<std::uint64_t>& counts = layout.Counts[source];
  for (std::size_t leaf = 0; leaf < counts.size(); ++leaf)
  {
    if (counts[leaf] > 0 && itemSize > 0)
    {
      this->Left.push_back({ static_cast<char*>(array) + layout.Firsts[source][leaf] * itemSize,
        counts[leaf] * itemSize });
    }
  }
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

PointExchange::PointExchange(const RankPoints& points, const Tiling& leaves, int threads)
  : PointSender(points, points.Points, std::size_t(leaves.size()), threads,
      [&points, finder = PartitionFinder(leaves)](
        std::size_t begin, std::size_t end, std::uint32_t* labels, std::vector<std::size_t>& counts)
      { finder.label(points.Points, begin, end, labels, counts); })
{
}

template <typename Id>
OwnedPoints<Id> PointExchange::exchange(
  Communicator& ranks, const std::vector<std::int32_t>& owners) const
{
  const PointLayout layout(ranks, owners, this->counts());
  for (std::size_t leaf = 0; leaf < owners.size(); ++leaf)
  {
    requireFitsKernel(layout.Starts[leaf + 1] - layout.Starts[leaf]);
  }
  OwnedPoints<Id> owned;
  static_cast<PointTuplesOf<Point2>&>(owned) = this->makeRoom(layout);
  // Triangles with other ranks' points are in addition to two per point. Untouched pages are not
  // committed.
  owned.Buckets = PointBuckets<Id>(layout.Starts, owned.Positions.data(), owned.size() / 8);
  parallelFor(this->Threads, this->Threads,
    [&](std::int64_t part) { owned.Buckets.populate(int(part), this->Threads); });
  const Packing packing = this->plan(owners, layout);
  // Messages are packed into the triangles' memory if they fit: fresh memory takes time.
  Bytes messages(owned.Buckets.release());
  const bool fits = packing.Size <= messages.size();
  if (!fits)
  {
    owned.Buckets.takeBack(Buffer<Id>(std::move(messages)));
    messages = Bytes(packing.Size);
  }
  messages = this->send(ranks, owners, layout, packing, std::move(messages), owned);
  if (fits)
  {
    owned.Buckets.takeBack(Buffer<Id>(std::move(messages)));
  }
  owned.FirstIds = firstIndices(ranks, std::int64_t(owned.size()));
  return owned;
}

template OwnedPoints<std::int32_t> PointExchange::exchange(
  Communicator&, const std::vector<std::int32_t>&) const;
template OwnedPoints<std::int64_t> PointExchange::exchange(
  Communicator&, const std::vector<std::int32_t>&) const;

} // namespace tipp
