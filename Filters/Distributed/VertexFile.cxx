// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/VertexFile.h"

#include "Files/IOError.h"
#include "Partitioned/Checksum.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace tipp
{

VertexFile::VertexFile(std::string path)
  : Path(std::move(path))
{
}

VertexFile::~VertexFile()
{
  if (this->File)
  {
    std::error_code ignored;
    std::filesystem::remove(this->Path, ignored);
  }
}

/// The first room that is large enough, else the end.
std::uint64_t VertexFile::allocate(std::uint64_t bytes)
{
  const auto found = std::find_if(this->Free.begin(), this->Free.end(),
    [bytes](const auto& room) { return room.second >= bytes; });
  if (found == this->Free.end())
  {
    return std::exchange(this->End, this->End + bytes);
  }
  const auto [offset, room] = *found;
  this->Free.erase(found);
  if (room > bytes)
  {
    this->Free.emplace(offset + bytes, room - bytes);
  }
  return offset;
}

VertexFile::Part VertexFile::put(const PlainVertex* vertices, std::size_t count)
{
  if (!this->File)
  {
    this->File = std::make_unique<OutputFile>(this->Path);
  }
  const std::uint64_t bytes = count * sizeof(PlainVertex);
  const Part part{ this->allocate(bytes), count, checksumOf(vertices, bytes) };
  this->File->write(part.Offset, vertices, bytes);
  if (!this->Source)
  {
    this->Source = std::make_unique<InputFile>(this->Path);
  }
  this->Used += bytes;
  this->Written += bytes;
  return part;
}

void VertexFile::get(const Part& part, std::vector<PlainVertex>& vertices) const
{
  const std::size_t before = vertices.size();
  const std::uint64_t bytes = part.Count * sizeof(PlainVertex);
  vertices.resize(before + part.Count);
  this->Source->read(part.Offset, vertices.data() + before, bytes);
  if (checksumOf(vertices.data() + before, bytes) != part.Checksum)
  {
    throw IOError(this->Path, "is damaged; resume the run.");
  }
}

void VertexFile::free(const Part& part)
{
  std::uint64_t offset = part.Offset;
  std::uint64_t bytes = part.Count * sizeof(PlainVertex);
  this->Used -= bytes;
  if (bytes == 0)
  {
    return;
  }
  auto next = this->Free.lower_bound(offset);
  if (next != this->Free.end() && offset + bytes == next->first)
  {
    bytes += next->second;
    next = this->Free.erase(next);
  }
  if (next != this->Free.begin())
  {
    const auto last = std::prev(next);
    if (last->first + last->second == offset)
    {
      offset = last->first;
      bytes += last->second;
      this->Free.erase(last);
    }
  }
  if (offset + bytes == this->End)
  {
    this->End = offset;
  }
  else
  {
    this->Free.emplace(offset, bytes);
  }
}

} // namespace tipp
