// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSectionFile_h
#define tippSectionFile_h

#include "Files/OutputFile.h"
#include "Messages/Bytes.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Names a section of a file: what it holds, and which piece it is for.
struct SectionKey
{
  std::uint32_t Kind = 0;
  std::int32_t Piece = 0;

  bool operator<(const SectionKey& other) const
  {
    return this->Kind != other.Kind ? this->Kind < other.Kind : this->Piece < other.Piece;
  }
};

/// Where a section lies in its file.
struct SectionEntry
{
  SectionKey Key;
  std::uint64_t Offset;
  std::uint64_t Size;
  std::uint64_t Checksum;
};

/// Writes a file of sections, which is read section by section. It takes its name when it is whole,
/// and is not changed any more.
class VTKTIPPFILTERS_EXPORT SectionFileWriter
{
public:
  /// Throws IOError, as all methods do.
  explicit SectionFileWriter(const std::string& path);

  void add(SectionKey key, const ByteWriter& content);
  /// Returns how many bytes the file has.
  std::uint64_t finish();

private:
  const std::string Path;
  OutputFile File;
  std::uint64_t End;
  std::vector<SectionEntry> Table;
};

/// A file of sections that is whole. Only its table is kept in memory, and no file is kept open.
class VTKTIPPFILTERS_EXPORT SectionFile
{
public:
  /// Throws IOError for what SectionFileWriter did not write.
  explicit SectionFile(const std::string& path);

  const std::vector<SectionEntry>& table() const { return this->Table; }
  bool has(SectionKey key) const { return this->find(key) != nullptr; }
  /// Throws IOError where the section is not there, or is damaged.
  Bytes read(SectionKey key) const;
  /// Reads all sections; throws IOError.
  void verify() const;

private:
  const SectionEntry* find(SectionKey key) const;

  std::string Path;
  std::vector<SectionEntry> Table; ///< by key
};

} // namespace tipp

#endif
