// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/SectionFile.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Partitioned/Checksum.h"

#include <algorithm>
#include <filesystem>

namespace tipp
{
namespace
{

constexpr const char* nextName = ".next"; // until it is whole

/// At the beginning of the file.
struct Header
{
  std::uint64_t TableOffset;
  std::uint64_t Entries;
  std::uint64_t TableChecksum;
};

bool isBefore(const SectionEntry& a, const SectionEntry& b)
{
  return a.Key < b.Key;
}

[[noreturn]] void refuse(const std::string& path)
{
  throw IOError(path, "is damaged.");
}

} // namespace

SectionFileWriter::SectionFileWriter(const std::string& path)
  : Path(path)
  , File(path + nextName)
  , End(sizeof(Header))
{
}

void SectionFileWriter::add(SectionKey key, const ByteWriter& content)
{
  this->Table.push_back(
    { key, this->End, content.size(), checksumOf(content.data(), content.size()) });
  this->File.write(this->End, content.data(), content.size());
  this->End += content.size();
}

std::uint64_t SectionFileWriter::finish()
{
  std::sort(this->Table.begin(), this->Table.end(), isBefore);
  const std::size_t bytes = this->Table.size() * sizeof(SectionEntry);
  const Header header{ this->End, this->Table.size(), checksumOf(this->Table.data(), bytes) };
  this->File.write(this->End, this->Table.data(), bytes);
  this->File.write(0, &header, sizeof(header));
  this->File.close();
  std::error_code failure;
  std::filesystem::rename(this->Path + nextName, this->Path, failure);
  if (failure)
  {
    throw IOError(this->Path, "cannot be replaced (" + failure.message() + ").");
  }
  return this->End + bytes;
}

SectionFile::SectionFile(const std::string& path)
  : Path(path)
{
  const InputFile file(path);
  Header header{};
  file.read(0, &header, sizeof(header));
  const std::uint64_t bytes = header.Entries * sizeof(SectionEntry);
  if (header.TableOffset > file.size() || header.Entries > file.size() ||
    bytes != file.size() - header.TableOffset)
  {
    refuse(path);
  }
  this->Table.resize(header.Entries);
  file.read(header.TableOffset, this->Table.data(), bytes);
  if (checksumOf(this->Table.data(), bytes) != header.TableChecksum)
  {
    refuse(path);
  }
}

const SectionEntry* SectionFile::find(SectionKey key) const
{
  const auto found = std::lower_bound(
    this->Table.begin(), this->Table.end(), SectionEntry{ key, 0, 0, 0 }, isBefore);
  return found == this->Table.end() || key < found->Key ? nullptr : &*found;
}

Bytes SectionFile::read(SectionKey key) const
{
  const SectionEntry* const entry = this->find(key);
  if (!entry)
  {
    refuse(this->Path);
  }
  Bytes bytes(entry->Size);
  InputFile(this->Path).read(entry->Offset, bytes.data(), bytes.size());
  if (checksumOf(bytes.data(), bytes.size()) != entry->Checksum)
  {
    refuse(this->Path);
  }
  return bytes;
}

void SectionFile::verify() const
{
  for (const SectionEntry& entry : this->Table)
  {
    this->read(entry.Key);
  }
}

} // namespace tipp
