// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScratchFiles_h
#define tippScratchFiles_h

#include "Files/OutputFile.h"
#include "Partitioned/PieceWriter.h"
#include "Ranks/Archive.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

template <typename Archive>
void serialize(Archive& archive, LentGroup& group)
{
  archive(group.To, group.Count);
}

/// What is known of a finished piece before it is published.
template <typename Archive>
void serialize(Archive& archive, FinishedPiece& piece)
{
  PieceTable& table = piece.Table;
  archive(piece.Summary, table.Offsets, table.PointGroups, table.CellGroups, table.Checksums,
    table.HeaderBytes, table.HeaderChecksum, piece.TriangleSum);
}

/// Saves what save() shows to an archive, with a checksum, and replaces the file `path` in one
/// step; keeps little of it in memory. Returns the file's size in bytes. Throws IOError.
VTKTIPPFILTERS_EXPORT std::uint64_t writeCheckedFile(
  const std::string& path, const std::function<void(SaveArchive&)>& save);

/// Throws IOError for a file that is not what writeCheckedFile() wrote.
VTKTIPPFILTERS_EXPORT Bytes readCheckedFile(const std::string& path);

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

/// Writes a file of sections, each with a checksum, which is read section by section. The file gets
/// its name when it is whole, and is never changed.
class VTKTIPPFILTERS_EXPORT SectionFileWriter
{
public:
  /// Throws IOError, as all methods do.
  explicit SectionFileWriter(const std::string& path);

  void add(SectionKey key, const SaveArchive& content);
  /// Returns how many bytes the file has.
  std::uint64_t finish();

private:
  const std::string Path;
  OutputFile File;
  std::uint64_t End;
  std::vector<SectionEntry> Table;
};

/// A whole file of sections. Only its table is kept in memory, and no file is kept open.
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
