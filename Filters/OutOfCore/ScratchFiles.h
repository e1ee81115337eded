// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScratchFiles_h
#define tippScratchFiles_h

#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Partitioned/PieceWriter.h"
#include "Ranks/Archive.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

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

  void add(SectionKey key, const Bytes& content);
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
  /// The section's size; 0 if it is not there.
  std::uint64_t bytes(SectionKey key) const
  {
    const SectionEntry* const entry = this->find(key);
    return entry ? entry->Size : 0;
  }
  /// Throws IOError where the section is not there, or is damaged.
  Bytes read(SectionKey key) const;
  /// Reads all sections; throws IOError.
  void verify() const;

private:
  const SectionEntry* find(SectionKey key) const;

  std::string Path;
  std::vector<SectionEntry> Table; ///< by key
};

/// The folders of a run's temporary files until its mesh is published: the spilled points, the
/// plan, and the results of pieces.
class ScratchFolder
{
public:
  static constexpr const char* planName = "/.plan";

  /// All files are beside the unfinished mesh if `other` is empty; else the points and the results
  /// are in a new folder in `other`. Throws IOError.
  ScratchFolder(const PendingFolder& mesh, const std::string& other);
  /// Removes everything but after keep().
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& folder() const { return this->Folder; }
  std::string points() const { return this->Folder + "/.points"; }
  std::string plan() const { return this->Work + planName; }
  /// How the paths of pieces' results begin.
  std::string results() const { return this->Folder + "/.piece"; }

  /// Whether there is a run to resume. Results without a plan are of one whose plan was lost.
  bool hasRun() const;
  /// Makes room for a new run, and its empty folder of pieces.
  void clear();
  void keep(bool kept = true)
  {
    this->Kept = kept;
    this->Listed.keep(kept);
  }
  /// Whether `bytes` more fit on the disks of the mesh and of this; throws IOError with the
  /// numbers. `path`: the mesh's, for the error.
  void requireSpace(const std::string& path, std::uint64_t mesh, std::uint64_t scratch) const;
  /// All but the plan, which the mesh's PendingFolder takes away with itself.
  void remove();

private:
  std::vector<std::string> files(const std::string& begin) const;
  void removeFiles(const std::string& begin) const;

  std::string Mesh;
  std::string Work;
  std::string Folder;
  TemporaryPath Listed; ///< Folder, if it is not Work
  bool Kept = false;
};

/// Whether there is a run of this path to resume, whose points are spilled.
VTKTIPPFILTERS_EXPORT bool canResume(const std::string& path);

} // namespace tipp

#endif
