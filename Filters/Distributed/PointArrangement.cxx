// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/PointArrangement.h"

#include "Parallel/ParallelFor.h"
#include "Triangulation/PartitionSizes.h"

#include <algorithm>
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

/// What each rank tells of this one's leaves.
std::vector<std::vector<std::uint64_t>> tellCounts(
  Postbox& ranks, const std::vector<std::int32_t>& owners, const std::vector<std::int64_t>& counts)
{
  std::vector<ByteWriter> writers(static_cast<std::size_t>(ranks.size()));
  for (std::size_t leaf = 0; leaf < owners.size(); ++leaf)
  {
    writers[std::size_t(owners[leaf])].value(std::uint64_t(counts[leaf]));
  }
  std::vector<Bytes> messages;
  messages.reserve(writers.size());
  for (ByteWriter& writer : writers)
  {
    messages.push_back(writer.take());
  }
  const std::size_t size = messages[std::size_t(ranks.rank())].size();
  std::vector<std::vector<std::uint64_t>> told;
  for (const Bytes& message : ranks.allToAll(std::move(messages)))
  {
    requireSize(message.size(), size);
    const auto* numbers = reinterpret_cast<const std::uint64_t*>(message.data());
    told.emplace_back(numbers, numbers + size / sizeof(std::uint64_t));
  }
  return told;
}

} // namespace

PointArrays::PointArrays(Bytes& message, std::size_t points)
  : Places(reinterpret_cast<Point2*>(message.data()))
  , Ids(reinterpret_cast<PointId*>(this->Places + points))
  , Rows(reinterpret_cast<char*>(this->Ids + points))
{
}

std::size_t PointArrays::bytes(std::size_t points, std::size_t rowSize)
{
  return points * (sizeof(Point2) + sizeof(PointId) + rowSize);
}

PointArrangement::PointArrangement(
  Postbox& ranks, const std::vector<std::int32_t>& owners, const std::vector<std::int64_t>& counts)
  : Rank(ranks.rank())
  , Counts(tellCounts(ranks, owners, counts))
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

void PointArrangement::unpack(
  int source, Bytes& message, const PointArrays& home, std::size_t rowSize, int threads) const
{
  const std::vector<std::uint64_t>& counts = this->Counts[std::size_t(source)];
  const std::vector<std::size_t>& firsts = this->Firsts[std::size_t(source)];
  std::vector<std::size_t> begins = { 0 };
  for (const std::uint64_t count : counts)
  {
    begins.push_back(begins.back() + count);
  }
  requireSize(message.size(), PointArrays::bytes(begins.back(), rowSize));
  const PointArrays from(message, begins.back());
  const auto bring = [&](std::int64_t leaf)
  {
    const std::size_t count = counts[std::size_t(leaf)];
    const std::size_t begin = begins[std::size_t(leaf)];
    const std::size_t first = firsts[std::size_t(leaf)];
    std::copy_n(from.Places + begin, count, home.Places + first);
    std::copy_n(from.Ids + begin, count, home.Ids + first);
    std::copy_n(from.Rows + begin * rowSize, count * rowSize, home.Rows + first * rowSize);
  };
  parallelFor(std::int64_t(counts.size()), threads, bring);
}

} // namespace tipp
