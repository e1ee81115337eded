// SPDX-License-Identifier: BSD-3-Clause
// A finished partition's messages, as ranks send them to each other.
#ifndef tippDoneMessage_h
#define tippDoneMessage_h

#include "Ranks/Archive.h"
#include "Triangulation/Tiling.h"

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{

/// Writes the messages whose recipient satisfies `isIncluded`.
template <typename Message>
Bytes writeDone(PartitionIndex sender, const std::vector<std::pair<PartitionIndex, Message>>& sent,
  const std::function<bool(PartitionIndex)>& isIncluded)
{
  SaveArchive writer;
  writer(sender);
  for (const auto& [to, message] : sent)
  {
    if (isIncluded(to))
    {
      writer(to, message);
    }
  }
  return writer.take();
}

/// Returns the messages and sets `sender`. Throws std::runtime_error if a partition is not below
/// `count`.
template <typename Message>
std::vector<std::pair<PartitionIndex, Message>> readDone(
  const Bytes& bytes, std::size_t count, PartitionIndex& sender)
{
  LoadArchive reader(bytes);
  const auto requirePartition = [count](PartitionIndex p)
  {
    if (p < 0 || std::size_t(p) >= count)
    {
      throw std::runtime_error("A message from another rank is damaged: no such partition.");
    }
  };
  sender = reader.get<PartitionIndex>();
  requirePartition(sender);
  std::vector<std::pair<PartitionIndex, Message>> sent;
  while (reader.left() > 0)
  {
    const auto to = reader.get<PartitionIndex>();
    requirePartition(to);
    sent.emplace_back(to, Message{});
    reader(sent.back().second);
    requirePartition(sent.back().second.Sender == sender ? sender : -1);
  }
  return sent;
}

} // namespace tipp

#endif
