// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInbox_h
#define tippInbox_h

#include "Messages/Bytes.h"
#include "Triangulation/BoundaryTriangles.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// What a partition sends to a later one: the vertices of the boundary triangles that it passes on
/// (Lemma 6), each once.
struct VertexMessage
{
  PartitionIndex Sender = -1; ///< -1: the initial mesh
  std::vector<BoundaryVertex> Vertices;
  std::int64_t Triangles = 0; ///< the number of triangles that these are the vertices of
};

/// @name Serialisation of vertices and messages
/// Reading throws std::runtime_error if the bytes were not written by these functions.
///@{
VTKTIPPFILTERS_EXPORT void write(ByteWriter& writer, const std::vector<BoundaryVertex>& vertices);
VTKTIPPFILTERS_EXPORT void write(ByteWriter& writer, const VertexMessage& message);
VTKTIPPFILTERS_EXPORT void read(ByteReader& reader, std::vector<BoundaryVertex>& vertices);
VTKTIPPFILTERS_EXPORT void read(ByteReader& reader, VertexMessage& message);
///@}

/// All messages of a finished partition, each with its recipient.
using SentMessages = std::vector<std::pair<PartitionIndex, VertexMessage>>;

/// @name Serialisation of a finished partition's messages
/// `writeDone` writes the messages whose recipient satisfies `isIncluded`. `readDone` returns the
/// messages and sets `sender`; it throws std::runtime_error if a partition is not below `count`.
///@{
VTKTIPPFILTERS_EXPORT Bytes writeDone(PartitionIndex sender, const SentMessages& sent,
  const std::function<bool(PartitionIndex)>& isIncluded);
VTKTIPPFILTERS_EXPORT SentMessages readDone(
  const Bytes& bytes, std::size_t count, PartitionIndex& sender);
///@}

/// Collects the vertices of several messages, each once.
class UniqueVertices
{
public:
  std::vector<BoundaryVertex> collect(const std::vector<VertexMessage>& messages);

private:
  std::vector<std::uint32_t> HashTable; ///< vertex indices; a member to reuse its memory
};

/// The messages sent to one partition. Any thread may add one, without a lock. The thread that
/// triangulates the partition takes them all once all senders are done.
class Inbox
{
public:
  Inbox() = default;
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;
  ~Inbox() { this->takeNodes(); }

  void put(VertexMessage&& message)
  {
    Node* const node = new Node{ std::move(message), this->Last.load(std::memory_order_relaxed) };
    while (!this->Last.compare_exchange_weak(
      node->Before, node, std::memory_order_release, std::memory_order_relaxed))
    {
    }
  }

  /// Removes and returns all messages, sorted by sender: the order of arrival does not matter.
  std::vector<VertexMessage> take()
  {
    std::vector<VertexMessage> messages = this->takeNodes();
    std::sort(messages.begin(), messages.end(),
      [](const VertexMessage& a, const VertexMessage& b) { return a.Sender < b.Sender; });
    return messages;
  }

private:
  struct Node
  {
    VertexMessage Message;
    Node* Before;
  };

  std::vector<VertexMessage> takeNodes()
  {
    std::vector<VertexMessage> messages;
    for (Node* node = this->Last.exchange(nullptr, std::memory_order_acquire); node;)
    {
      const std::unique_ptr<Node> taken(node);
      messages.push_back(std::move(taken->Message));
      node = taken->Before;
    }
    return messages;
  }

  std::atomic<Node*> Last{ nullptr };
};

} // namespace tipp

#endif
