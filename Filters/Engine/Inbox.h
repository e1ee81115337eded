// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInbox_h
#define tippInbox_h

#include "Engine/PartitionSchedule.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace tipp
{

/// What a partition sends to a later one: the vertices of the boundary cells that it passes on
/// (Lemma 6), each once.
template <typename Vertex>
struct VertexMessageOf
{
  PartitionIndex Sender = NoPartition; ///< NoPartition: the initial mesh
  std::int64_t Cells = 0;              ///< the number of cells that these are the vertices of
  std::vector<Vertex> Vertices;
};

/// Returns the number of cells that the messages' vertices belong to: the sum of Cells.
template <typename Vertex>
std::int64_t cellsOf(const std::vector<VertexMessageOf<Vertex>>& messages)
{
  return std::accumulate(messages.begin(), messages.end(), std::int64_t(0),
    [](std::int64_t sum, const auto& message) { return sum + message.Cells; });
}

template <typename Archive, typename Vertex>
void serialize(Archive& archive, VertexMessageOf<Vertex>& message)
{
  archive(message.Sender, message.Cells, message.Vertices);
}

/// Messages with their recipients.
template <typename Vertex>
using SentMessagesOf = std::vector<std::pair<PartitionIndex, VertexMessageOf<Vertex>>>;

/// Returns messages with the vertices of cells, each vertex once per message. `cells` has a list
/// for each recipient, and a message's recipient is the index of its list. A list without cells
/// gives no message. A cell is an array of indices below `vertexEnd`; vertexAt(index) returns a
/// vertex.
template <typename Cell, typename VertexAt>
auto messagesWith(PartitionIndex sender, const std::vector<std::vector<Cell>>& cells,
  std::size_t vertexEnd, const VertexAt& vertexAt)
{
  using Vertex = std::decay_t<decltype(vertexAt(cells[0][0][0]))>;
  SentMessagesOf<Vertex> messages;
  std::vector<std::uint32_t> sentTo(vertexEnd, 0); // by vertex: its last recipient, counted from 1
  std::uint32_t recipient = 0;
  for (const std::vector<Cell>& list : cells)
  {
    VertexMessageOf<Vertex> message{ sender, std::int64_t(list.size()), {} };
    ++recipient;
    for (const Cell& cell : list)
    {
      for (const auto index : cell)
      {
        if (std::exchange(sentTo[std::size_t(index)], recipient) != recipient)
        {
          message.Vertices.push_back(vertexAt(index));
        }
      }
    }
    if (!list.empty())
    {
      messages.emplace_back(PartitionIndex(recipient - 1), std::move(message));
    }
  }
  return messages;
}

/// Returns messages that send each cell of an initial mesh to the first partition that it meets.
/// Cells that meet no partition are dropped: a cell meets the partition of each true corner, so
/// these have only artificial corners, and nobody needs them.
template <typename Mesh>
auto sendInitialMesh(const Mesh& mesh, const PartitionOrder& order)
{
  std::vector<std::decay_t<decltype(mesh.Cells)>> cells(order.partitionCount());
  for (std::size_t i = 0; i < mesh.Cells.size(); ++i)
  {
    if (mesh.metBegin(i) != mesh.metEnd(i))
    {
      cells[std::size_t(order.first(mesh.metBegin(i), mesh.metEnd(i)))].push_back(mesh.Cells[i]);
    }
  }
  return messagesWith(NoPartition, cells, mesh.Vertices.size(),
    [&mesh](std::uint32_t index) { return mesh.Vertices[index]; });
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
