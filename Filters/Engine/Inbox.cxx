// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/Inbox.h"

#include <stdexcept>

namespace tipp
{
namespace
{

/// A vertex without padding.
struct WrittenVertex
{
  Point2 Position;
  std::int64_t Id;
  std::int64_t Partition;
};

} // namespace

void write(ByteWriter& writer, const std::vector<BoundaryVertex>& vertices)
{
  std::vector<WrittenVertex> written;
  written.reserve(vertices.size());
  for (const BoundaryVertex& v : vertices)
  {
    written.push_back({ v.Position, v.Id, v.Partition });
  }
  writer.array(written);
}

void write(ByteWriter& writer, const VertexMessage& message)
{
  writer.value(message.Sender);
  writer.value(message.Triangles);
  write(writer, message.Vertices);
}

void read(ByteReader& reader, std::vector<BoundaryVertex>& vertices)
{
  const std::vector<WrittenVertex> written = reader.array<WrittenVertex>();
  vertices.reserve(vertices.size() + written.size());
  for (const WrittenVertex& v : written)
  {
    vertices.push_back({ v.Position, v.Id, static_cast<PartitionIndex>(v.Partition) });
  }
}

void read(ByteReader& reader, VertexMessage& message)
{
  message.Sender = reader.value<PartitionIndex>();
  message.Triangles = reader.value<std::int64_t>();
  message.Vertices.clear();
  read(reader, message.Vertices);
}

Bytes writeDone(PartitionIndex sender, const SentMessages& sent,
  const std::function<bool(PartitionIndex)>& isIncluded)
{
  ByteWriter writer;
  writer.value(sender);
  for (const auto& [to, message] : sent)
  {
    if (isIncluded(to))
    {
      writer.value(to);
      write(writer, message);
    }
  }
  return writer.take();
}

SentMessages readDone(const Bytes& bytes, std::size_t count, PartitionIndex& sender)
{
  ByteReader reader(bytes);
  const auto requirePartition = [count](PartitionIndex p)
  {
    if (p < 0 || std::size_t(p) >= count)
    {
      throw std::runtime_error("A message from another rank is damaged: no such partition.");
    }
  };
  sender = reader.value<PartitionIndex>();
  requirePartition(sender);
  SentMessages sent;
  while (reader.left() > 0)
  {
    const auto to = reader.value<PartitionIndex>();
    requirePartition(to);
    sent.emplace_back(to, VertexMessage{});
    read(reader, sent.back().second);
    requirePartition(sent.back().second.Sender == sender ? sender : -1);
  }
  return sent;
}

std::vector<BoundaryVertex> UniqueVertices::collect(const std::vector<VertexMessage>& messages)
{
  std::size_t count = 0;
  for (const VertexMessage& message : messages)
  {
    count += message.Vertices.size();
  }
  std::size_t size = 64;
  while (size < 2 * count)
  {
    size *= 2;
  }
  constexpr std::uint32_t empty = ~0U;
  this->HashTable.assign(size, empty);
  std::vector<BoundaryVertex> vertices;
  vertices.reserve(count);
  for (const VertexMessage& message : messages)
  {
    for (const BoundaryVertex& v : message.Vertices)
    {
      std::size_t at = ((std::uint64_t(v.Id) * 0x9e3779b97f4a7c15U) >> 32) & (size - 1);
      while (this->HashTable[at] != empty && vertices[this->HashTable[at]].Id != v.Id)
      {
        at = (at + 1) & (size - 1);
      }
      if (this->HashTable[at] == empty)
      {
        this->HashTable[at] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(v);
      }
    }
  }
  return vertices;
}

} // namespace tipp
