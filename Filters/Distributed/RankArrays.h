// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankArrays_h
#define tippRankArrays_h

#include "Messages/Communicator.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace tipp
{

/// A triangle: three internal ids, indices among all ranks' owned points.
using IdTriangle = std::array<std::int64_t, 3>;

/// The rank that owns a point with an internal id; `firstIds` has each rank's first id, and the
/// end. Throws std::runtime_error if no rank owns it.
inline std::size_t ownerOf(std::int64_t id, const std::vector<std::int64_t>& firstIds)
{
  const auto next = std::upper_bound(firstIds.begin(), firstIds.end(), id);
  if (next == firstIds.begin() || next == firstIds.end())
  {
    throw std::runtime_error("A triangle from another rank is damaged: it has no such vertex.");
  }
  return std::size_t(next - firstIds.begin()) - 1;
}

/// Sends one array to each rank; returns one from each rank. Collective.
template <typename T>
std::vector<std::vector<T>> swapArrays(
  Communicator& ranks, const std::vector<std::vector<T>>& toRanks)
{
  std::vector<Bytes> messages;
  for (const std::vector<T>& values : toRanks)
  {
    ByteWriter writer;
    writer.array(values);
    messages.push_back(writer.take());
  }
  std::vector<std::vector<T>> received;
  for (const Bytes& message : ranks.allToAll(std::move(messages)))
  {
    received.push_back(ByteReader(message).array<T>());
  }
  return received;
}

} // namespace tipp

#endif
