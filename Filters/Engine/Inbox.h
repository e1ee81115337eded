// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInbox_h
#define tippInbox_h

#include "Ranks/Communicator.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{

/// What a partition sends to a later one: the vertices of the boundary cells that it passes on
/// (Lemma 6), each once.
template <typename Vertex>
struct VertexMessageOf
{
  PartitionIndex Sender = -1; ///< -1: the initial mesh
  std::vector<Vertex> Vertices;
};

template <typename Archive, typename Vertex>
void serialize(Archive& archive, VertexMessageOf<Vertex>& message)
{
  archive(message.Sender, message.Vertices);
}

/// The messages sent to one partition; a message has the member `Sender`. Any thread may add one,
/// without a lock. The thread that triangulates the partition takes them all once all senders are
/// done.
template <typename Message>
class MessageInbox
{
public:
  MessageInbox() = default;
  MessageInbox(const MessageInbox&) = delete;
  MessageInbox& operator=(const MessageInbox&) = delete;
  ~MessageInbox() { this->takeNodes(); }

  void put(Message&& message)
  {
    Node* const node = new Node{ std::move(message), this->Last.load(std::memory_order_relaxed) };
    while (!this->Last.compare_exchange_weak(
      node->Before, node, std::memory_order_release, std::memory_order_relaxed))
    {
    }
  }

  /// Removes and returns all messages, sorted by sender: the order of arrival does not matter.
  std::vector<Message> take()
  {
    std::vector<Message> messages = this->takeNodes();
    std::sort(messages.begin(), messages.end(),
      [](const Message& a, const Message& b) { return a.Sender < b.Sender; });
    return messages;
  }

private:
  struct Node
  {
    Message Content;
    Node* Before;
  };

  std::vector<Message> takeNodes()
  {
    std::vector<Message> messages;
    for (Node* node = this->Last.exchange(nullptr, std::memory_order_acquire); node;)
    {
      const std::unique_ptr<Node> taken(node);
      messages.push_back(std::move(taken->Content));
      node = taken->Before;
    }
    return messages;
  }

  std::atomic<Node*> Last{ nullptr };
};

/// @name A finished partition's messages, as ranks send them to each other
///@{
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

///@}

} // namespace tipp

#endif
