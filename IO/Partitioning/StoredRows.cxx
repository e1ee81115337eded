// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/StoredRows.h"

#include <cstring>

namespace tipp
{
namespace
{

constexpr std::size_t bufferBytes = std::size_t(1) << 20;

void appendBytes(const void* row, std::size_t bytes, std::vector<char>& buffer)
{
  const char* const begin = static_cast<const char*>(row);
  buffer.insert(buffer.end(), begin, begin + bytes);
}

} // namespace

RowFile::RowFile(const std::string& path, std::size_t rowBytes)
  : File(path)
  , RowBytes(rowBytes)
  , Out(std::make_unique<OutputFile>(path))
{
}

void RowFile::append(const void* row)
{
  appendBytes(row, this->RowBytes, this->Buffer);
  ++this->Count;
  this->Buffer.size() >= bufferBytes ? this->flush() : void();
}

void RowFile::flush()
{
  this->Out->write(this->Written, this->Buffer.data(), this->Buffer.size());
  this->Written += this->Buffer.size();
  this->Buffer.clear();
}

void RowFile::finish()
{
  this->flush();
  std::vector<char>().swap(this->Buffer);
  this->Out->close();
  this->Out.reset();
  this->In = std::make_unique<InputFile>(this->File.Path);
}

void RowFile::read(std::int64_t first, std::size_t count, void* to) const
{
  this->In->read(std::uint64_t(first) * this->RowBytes, to, count * this->RowBytes);
}

KeyedRows::KeyedRows(const std::string& path, std::size_t keys, std::size_t rowBytes)
  : File(path + ".0") // the name that Spill gives it
  , Rows(path, 0, keys, rowBytes)
{
}

void KeyedRows::add(std::size_t key, const void* row)
{
  this->BufferedKeys.push_back(std::uint32_t(key));
  appendBytes(row, this->Rows.rowBytes(), this->Buffer);
  this->Buffer.size() >= bufferBytes ? this->flush() : void();
}

void KeyedRows::flush()
{
  this->Rows.add(
    this->BufferedKeys.size(), 1, [this](std::size_t i) { return this->BufferedKeys[i]; },
    [this, bytes = this->Rows.rowBytes()](std::size_t i, char* to)
    { std::memcpy(to, this->Buffer.data() + i * bytes, bytes); });
  this->BufferedKeys.clear();
  this->Buffer.clear();
}

void KeyedRows::finish()
{
  this->flush();
  std::vector<char>().swap(this->Buffer);
  std::vector<std::uint32_t>().swap(this->BufferedKeys);
  this->Rows.finish();
}

} // namespace tipp
