// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/PointArrangement.h"

#include "Triangulation/Tiling.h"

#include <algorithm>
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
std::vector<std::vector<std::uint64_t>> tellCounts(Communicator& ranks,
  const std::vector<std::int32_t>& owners, const std::vector<std::int64_t>& counts)
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

PointArrays::PointArrays(char* memory, std::size_t points)
  : Places(reinterpret_cast<Point2*>(memory))
  , Ids(reinterpret_cast<PointId*>(this->Places + points))
  , Rows(reinterpret_cast<char*>(this->Ids + points))
{
}

std::size_t PointArrays::bytes(std::size_t points, std::size_t rowSize)
{
  return points * (sizeof(Point2) + sizeof(PointId) + rowSize);
}

PointArrangement::PointArrangement(Communicator& ranks, const std::vector<std::int32_t>& owners,
  const std::vector<std::int64_t>& counts)
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

PointLanding::PointLanding(const PointArrangement& arrangement, std::size_t source,
  const PointArrays& home, std::size_t rowSize)
{
  const std::vector<std::uint64_t>& counts = arrangement.Counts[source];
  const std::vector<std::size_t>& firsts = arrangement.Firsts[source];
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
  add(reinterpret_cast<char*>(home.Places), sizeof(Point2));
  add(reinterpret_cast<char*>(home.Ids), sizeof(PointId));
  add(home.Rows, rowSize);
  std::reverse(this->Left.begin(), this->Left.end());
}

void PointLanding::take(const char* part, std::size_t size)
{
  while (size > 0)
  {
    if (this->Left.empty())
    {
      throw std::runtime_error("Points from another rank are damaged: they are more than it told.");
    }
    Place& place = this->Left.back();
    const std::size_t taken = std::min(size, place.Size);
    std::memcpy(place.To, part, taken);
    part += taken;
    size -= taken;
    place = { place.To + taken, place.Size - taken };
    if (place.Size == 0)
    {
      this->Left.pop_back();
    }
  }
}

void PointLanding::requireComplete() const
{
  if (!this->Left.empty())
  {
    throw std::runtime_error("Points from another rank are damaged: they are fewer than it told.");
  }
}

} // namespace tipp
