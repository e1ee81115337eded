// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInbox_h
#define tippInbox_h

#include "Messages/Bytes.h"
#include "Triangulation/SeamTriangles.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// What a partition sends to a later one: the vertices of the boundary triangles that it hands over
/// (Lemma 6), each once.
struct VertexMessage
{
  PartitionIndex Sender = -1; ///< -1: the initial mesh
  std::vector<SeamVertex> Vertices;
  std::int64_t Triangles = 0; ///< how many triangles these are the vertices of
};

/// @name Vertices and messages as bytes
/// What was not written here throws std::runtime_error when it is read.
///@{
VTKTIPPFILTERS_EXPORT void write(ByteWriter& writer, const std::vector<SeamVertex>& vertices);
VTKTIPPFILTERS_EXPORT void write(ByteWriter& writer, const VertexMessage& message);
VTKTIPPFILTERS_EXPORT void read(ByteReader& reader, std::vector<SeamVertex>& vertices);
VTKTIPPFILTERS_EXPORT void read(ByteReader& reader, VertexMessage& message);
///@}

/// What a finished partition sends, each message with its recipient.
using SentMessages = std::vector<std::pair<PartitionIndex, VertexMessage>>;

/// @name A finished partition and what it sends to some of the others, as bytes
/// `readDone` throws std::runtime_error for partitions that are not among `count`.
///@{
VTKTIPPFILTERS_EXPORT Bytes writeDone(PartitionIndex sender, const SentMessages& sent,
  const std::function<bool(PartitionIndex)>& isIncluded);
VTKTIPPFILTERS_EXPORT SentMessages readDone(
  const Bytes& bytes, std::size_t count, PartitionIndex& sender);
///@}

/// All vertices of some messages, each once.
class UniqueVertices
{
public:
  std::vector<SeamVertex> collect(const std::vector<VertexMessage>& messages);

private:
  std::vector<std::uint32_t> HashTable; ///< of indices of vertices; kept for its memory
};

/// The messages that wait for one partition. Any thread may put one in, without a lock; the thread
/// that triangulates the partition takes them all out once all senders are done.
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

  /// All messages, by sender: in which order they came in does not matter.
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
