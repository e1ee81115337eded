// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFortranRecords_h
#define tippFortranRecords_h

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Reads the records of a Fortran program's unformatted file: each has its length in bytes before
/// and after it, as 32-bit integers. Throws IOError.
class FortranRecords
{
public:
  /// The first record must have `firstBytes` bytes, which shows the byte order.
  FortranRecords(const std::string& path, std::uint32_t firstBytes)
    : File(path)
  {
    std::uint32_t length = 0;
    this->File.read(0, &length, sizeof length);
    this->IsSwapped = length != firstBytes;
    if (this->valueFrom<std::uint32_t>(reinterpret_cast<const char*>(&length)) != firstBytes)
    {
      throw IOError(
        path, "does not begin as a SELAFIN file does; check its name or copy it again.");
    }
  }

  const std::string& path() const { return this->File.path(); }
  std::uint64_t size() const { return this->File.size(); }
  std::uint64_t offset() const { return this->Offset; }

  template <typename T>
  T valueFrom(const char* bytes) const
  {
    std::array<char, sizeof(T)> raw{};
    std::copy_n(bytes, sizeof(T), raw.begin());
    if (this->IsSwapped)
    {
      std::reverse(raw.begin(), raw.end());
    }
    return valueAt<T>(raw.data());
  }

  /// Reads the next record, of any length.
  std::vector<char> next(const std::string& what)
  {
    return this->next(this->lengthAt(this->Offset), what);
  }

  /// Reads the next record, which must have `length` bytes.
  std::vector<char> next(std::uint64_t length, const std::string& what)
  {
    std::vector<char> bytes = this->at(this->Offset, length, what);
    this->Offset += length + 2 * sizeof(std::uint32_t);
    return bytes;
  }

  /// Reads the record at an offset, which must have `length` bytes.
  std::vector<char> at(std::uint64_t offset, std::uint64_t length, const std::string& what) const
  {
    constexpr std::uint64_t marks = 2 * sizeof(std::uint32_t);
    if (length > this->File.size() || offset + length + marks > this->File.size())
    {
      throw IOError(this->path(), "ends before the end of " + what + "; copy it again.");
    }
    if (this->lengthAt(offset) != length ||
      this->lengthAt(offset + length + sizeof(std::uint32_t)) != length)
    {
      throw IOError(this->path(),
        "is damaged: the record of " + what + " at byte " + std::to_string(offset) +
          " should have " + std::to_string(length) + " bytes; copy it again.");
    }
    std::vector<char> bytes(static_cast<std::size_t>(length));
    this->File.read(offset + sizeof(std::uint32_t), bytes.data(), bytes.size());
    return bytes;
  }

private:
  std::uint64_t lengthAt(std::uint64_t offset) const
  {
    std::array<char, sizeof(std::uint32_t)> raw{};
    this->File.read(offset, raw.data(), raw.size());
    return this->valueFrom<std::uint32_t>(raw.data());
  }

  InputFile File;
  bool IsSwapped = false; ///< the file is big-endian, as most are
  std::uint64_t Offset = 0;
};

} // namespace tipp

#endif
