// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScratchFiles_h
#define tippScratchFiles_h

#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Files/WorkFolder.h"
#include "Ranks/Archive.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Writes the data that save() puts into an archive, with a checksum, and replaces the file `path`
/// in one step. Keeps only a small part of the data in memory. Throws IOError.
VTKTIPPFILTERS_EXPORT void writeCheckedFile(
  const std::string& path, const std::function<void(SaveArchive&)>& save);

/// Reads a file that writeCheckedFile() wrote. Throws IOError if it is missing or damaged.
VTKTIPPFILTERS_EXPORT Bytes readCheckedFile(const std::string& path);

/// Identifies a section of a file: the kind of its content, and the piece that it is for.
struct SectionKey
{
  std::uint32_t Kind = 0;
  std::int32_t Piece = 0;

  bool operator<(const SectionKey& other) const
  {
    return this->Kind != other.Kind ? this->Kind < other.Kind : this->Piece < other.Piece;
  }
};

/// The position of a section in its file, in bytes.
struct SectionEntry
{
  SectionKey Key;
  std::uint64_t Offset;
  std::uint64_t Size;
  std::uint64_t Checksum;
};

/// Writes a file of sections, each with a checksum, which can be read section by section. The file
/// gets its name when it is complete, and is never changed after that.
class VTKTIPPFILTERS_EXPORT SectionFileWriter
{
public:
  /// Opens the file under a temporary name. Throws IOError, as all methods do.
  explicit SectionFileWriter(const std::string& path);

  void add(SectionKey key, const Bytes& content);
  /// Completes the file.
  void finish();

private:
  const std::string Path;
  OutputFile File;
  std::uint64_t End;
  std::vector<SectionEntry> Table;
};

/// A complete file of sections, for reading. Only its table is kept in memory, and the file is not
/// kept open.
class VTKTIPPFILTERS_EXPORT SectionFile
{
public:
  /// Reads the table. Throws IOError if SectionFileWriter did not write the file.
  explicit SectionFile(const std::string& path);

  bool has(SectionKey key) const { return this->find(key) != nullptr; }
  /// Returns the size of a section in bytes; 0 if it does not exist.
  std::uint64_t bytes(SectionKey key) const
  {
    const SectionEntry* const entry = this->find(key);
    return entry ? entry->Size : 0;
  }
  /// Reads a section. Throws IOError if it does not exist or is damaged.
  Bytes read(SectionKey key) const;
  /// Reads all sections. Throws IOError if one is damaged.
  void verify() const;

private:
  const SectionEntry* find(SectionKey key) const;

  std::string Path;
  std::vector<SectionEntry> Table; ///< sorted by key
};

/// The temporary files of a run until the mesh is published: the plan beside the unfinished mesh,
/// and the spilled points and the results of pieces there or on another disk.
class ScratchFolder
{
public:
  static constexpr const char* planName = "/.plan";

  /// `other`: a folder on another disk, in which a new folder gets the points and results. Empty:
  /// all files are beside the unfinished mesh. Throws IOError. `mesh` must outlive this object.
  ScratchFolder(PendingFolder& mesh, const std::string& other);
  /// Removes all files except the plan, which the mesh's PendingFolder removes with itself. Removes
  /// none if keep() was called.
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& folder() const
  {
    return this->Other ? this->Other->path() : this->Mesh.workPath();
  }
  std::string points() const { return this->folder() + "/.points"; }
  std::string plan() const { return this->Mesh.workPath() + planName; }
  /// Returns the prefix of the paths of results.
  std::string results() const { return this->folder() + "/.piece"; }

  /// Returns whether there is a run to resume. Results without a plan are from a run that lost its
  /// plan.
  bool hasRun() const;
  /// Removes the files of earlier runs, and makes an empty folder for the pieces.
  void clear();
  bool isKept() const { return this->Mesh.work().isKept(); }
  /// Sets whether the files and the unfinished mesh stay, so that the run can be resumed.
  void keep(bool kept = true);
  /// Throws IOError, with the numbers, unless the disks of the mesh and of this folder have space
  /// for `mesh` and `scratch` more bytes. `path`: of the mesh, for the message.
  void requireSpace(const std::string& path, std::uint64_t mesh, std::uint64_t scratch) const;

private:
  std::vector<std::string> files(const std::string& begin) const;
  void removeFiles(const std::string& begin) const;

  PendingFolder& Mesh;
  std::unique_ptr<WorkFolder> Other;
};

/// Returns whether there is a run for this mesh to resume: its points are spilled.
VTKTIPPFILTERS_EXPORT bool canResume(const std::string& path);

} // namespace tipp

#endif
