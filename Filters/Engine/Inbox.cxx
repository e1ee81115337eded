// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/Inbox.h"

namespace tipp
{

std::vector<SeamVertex> UniqueVertices::collect(const std::vector<VertexMessage>& messages)
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
  std::vector<SeamVertex> vertices;
  vertices.reserve(count);
  for (const VertexMessage& message : messages)
  {
    for (const SeamVertex& v : message.Vertices)
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
