// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInbox_h
#define tippInbox_h

#include "Triangulation/Tiling.h"

#include <algorithm>
#include <atomic>
#include <memory>
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

} // namespace tipp

#endif
