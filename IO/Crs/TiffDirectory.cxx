// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/TiffDirectory.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <utility>

namespace tipp
{
namespace
{

/// The size of a value of TIFF's types 1 to 18; 0 for those that do not exist (TIFF 6.0, section 2;
/// types 16 to 18 are BigTIFF's).
std::size_t sizeOfType(std::uint16_t type)
{
  constexpr std::array<std::size_t, 19> sizes = { 0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8,
    8, 8 };
  return type < sizes.size() ? sizes[type] : 0;
}

} // namespace

TiffDirectory TiffDirectory::ofFile(const std::string& path)
{
  const auto file = std::make_shared<InputFile>(path);
  return { path, file->size(),
    [file](std::uint64_t offset, void* to, std::size_t bytes) { file->read(offset, to, bytes); } };
}

TiffDirectory::TiffDirectory(const std::string& bytes)
  : TiffDirectory("The GeoTIFF in memory", bytes.size(),
      [&bytes](std::uint64_t offset, void* to, std::size_t count)
      { std::memcpy(to, bytes.data() + offset, count); })
{
}

TiffDirectory::TiffDirectory(const std::string& name, std::uint64_t size, Read read)
  : Name(name)
  , Size(size)
  , ReadBytes(std::move(read))
{
  const std::string order = size >= 8 ? this->bytesAt(0, 2) : "";
  this->IsBigEndian = order == "MM";
  const std::uint64_t version = order == "II" || order == "MM" ? this->numberAt(2, 2) : 0;
  if (version != 42 && version != 43)
  {
    this->fail("is no TIFF file");
  }
  const bool isBig = version == 43;
  this->Word = isBig ? 8 : 4;
  const std::uint64_t directory = this->wordAt(isBig ? 8 : 4);
  const std::uint64_t count = this->numberAt(directory, isBig ? 8 : 2);
  const std::uint64_t entrySize = 4 + 2 * this->Word;
  constexpr std::uint64_t mostEntries = 4096;
  if (count > mostEntries)
  {
    this->fail("gives too large a number of fields");
  }
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::uint64_t at = directory + (isBig ? 8 : 2) + i * entrySize;
    this->Entries.emplace(std::uint16_t(this->numberAt(at, 2)),
      Entry{ std::uint16_t(this->numberAt(at + 2, 2)), this->wordAt(at + 4), at + 4 + this->Word });
  }
}

void TiffDirectory::fail(const std::string& problem) const
{
  throw IOError(this->Name, problem + "; copy or write it again.");
}

std::string TiffDirectory::bytesAt(std::uint64_t offset, std::uint64_t size) const
{
  if (offset > this->Size || size > this->Size - offset)
  {
    this->fail("ends before the values of its directory");
  }
  std::string bytes(std::size_t(size), '\0');
  this->ReadBytes(offset, bytes.data(), bytes.size());
  return bytes;
}

std::uint64_t TiffDirectory::numberAt(std::uint64_t offset, std::size_t size) const
{
  std::string bytes = this->bytesAt(offset, size);
  if (this->IsBigEndian)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data(), size);
  return number;
}

std::uint64_t TiffDirectory::wordAt(std::uint64_t offset) const
{
  return this->numberAt(offset, this->Word);
}

TiffField TiffDirectory::field(std::uint16_t tag) const
{
  const auto found = this->Entries.find(tag);
  if (found == this->Entries.end())
  {
    return { tag, TiffField::Type::Text, "" };
  }
  const Entry& entry = found->second;
  const std::size_t each = sizeOfType(entry.Type);
  constexpr std::uint64_t most = 1 << 20; // more than 65535 keys and what they refer to
  if (each == 0 || entry.Count > most)
  {
    this->fail("has a damaged field (tag " + std::to_string(tag) + ")");
  }
  const std::uint64_t size = entry.Count * each;
  std::string bytes = this->bytesAt(size > this->Word ? this->wordAt(entry.At) : entry.At, size);
  for (std::size_t at = 0; this->IsBigEndian && at < bytes.size(); at += each)
  {
    std::reverse(bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(at + each));
  }
  return { tag, static_cast<TiffField::Type>(entry.Type), std::move(bytes) };
}

std::vector<double> TiffDirectory::numbers(std::uint16_t tag) const
{
  const TiffField found = this->field(tag);
  const std::size_t each = sizeOfType(static_cast<std::uint16_t>(found.Is));
  std::vector<double> values;
  for (std::size_t at = 0; at < found.Bytes.size(); at += each)
  {
    double value = 0;
    std::uint64_t number = 0;
    switch (found.Is)
    {
      case TiffField::Type::Double:
        std::memcpy(&value, found.Bytes.data() + at, each);
        break;
      case TiffField::Type::Short:
      case TiffField::Type::Long:
      case TiffField::Type::Long8:
        std::memcpy(&number, found.Bytes.data() + at, each);
        value = double(number);
        break;
      default:
        this->fail("has no numbers in a field (tag " + std::to_string(tag) + ")");
    }
    values.push_back(value);
  }
  return values;
}

std::vector<TiffField> geoFieldsOf(const TiffDirectory& directory)
{
  std::vector<TiffField> fields;
  for (const std::uint16_t tag : { 34735, 34736, 34737 })
  {
    if (directory.has(tag))
    {
      fields.push_back(directory.field(tag));
    }
  }
  return fields;
}

} // namespace tipp
