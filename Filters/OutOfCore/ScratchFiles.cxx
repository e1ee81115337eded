// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/ScratchFiles.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Partitioned/Checksum.h"

#include <algorithm>
#include <filesystem>

namespace tipp
{
namespace
{

constexpr const char* nextSuffix = ".next"; // until a file is whole

void takeName(const std::string& path)
{
  std::error_code failure;
  std::filesystem::rename(path + nextSuffix, path, failure);
  if (failure)
  {
    throw IOError(path, "cannot be replaced (" + failure.message() + ").");
  }
}

/// At the beginning of a file of sections.
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

std::uint64_t writeCheckedFile(
  const std::string& path, const std::function<void(SaveArchive&)>& save)
{
  std::uint64_t end = 8;
  {
    const OutputFile file(path + nextSuffix);
    Checksum sum;
    SaveArchive archive;
    archive.setSink(
      [&](const char* data, std::size_t size)
      {
        sum.add(data, size);
        file.write(end, data, size);
        end += size;
      });
    save(archive);
    archive.flush();
    const std::uint64_t checksum = sum.finish();
    file.write(0, &checksum, 8);
  }
  takeName(path);
  return end;
}

Bytes readCheckedFile(const std::string& path)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
  {
    throw IOError(path, "is missing; remove its folder and start again.");
  }
  const InputFile file(path);
  if (file.size() >= 8)
  {
    std::uint64_t checksum = 0;
    file.read(0, &checksum, 8);
    Bytes bytes(file.size() - 8);
    file.read(8, bytes.data(), bytes.size());
    if (checksumOf(bytes.data(), bytes.size()) == checksum)
    {
      return bytes;
    }
  }
  throw IOError(path, "is damaged; remove its folder and start again.");
}

SectionFileWriter::SectionFileWriter(const std::string& path)
  : Path(path)
  , File(path + nextSuffix)
  , End(sizeof(Header))
{
}

void SectionFileWriter::add(SectionKey key, const SaveArchive& content)
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
  takeName(this->Path);
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
