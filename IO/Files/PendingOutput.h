// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPendingOutput_h
#define tippPendingOutput_h

#include "Files/OutputFile.h"
#include "Files/TemporaryPaths.h"
#include "Files/WorkFolder.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// What is at a path. If two states differ, another file or folder is there, or the file was
/// written to.
struct PathState
{
  /// Device, inode, size in bytes, and time of the last change in seconds and nanoseconds; the last
  /// three are 0 unless it is a regular file. nullopt: there is nothing at the path.
  std::optional<std::array<std::uint64_t, 5>> Values;
};

PathState stateOf(const std::string& path);

/// An output file with a temporary name in its own folder, which commit() moves to its path;
/// without commit() the destructor removes it. So a failed or aborted run leaves no partial file,
/// and the previous file stays. Files left behind by a killed process are removed by the next run
/// for the same path.
class VTKTIPPIO_EXPORT PendingFile
{
public:
  /// Throws IOError if the file cannot be created or something other than a regular file is at the
  /// path. `before` is the path's state when the run began, from before() of an earlier object;
  /// commit() replaces nothing else. nullopt: the present state.
  explicit PendingFile(
    const std::string& path, const std::optional<PathState>& before = std::nullopt);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const PathState& before() const { return this->Before; }

  /// The temporary file to write to.
  const OutputFile& file() const { return *this->File; }
  const std::string& temporaryPath() const { return this->Temporary; }
  /// Unlocks the temporary file, for libraries that lock a file while they write it, such as HDF5.
  void unlock() const;

  /// Moves the file to its path once it is on the disk. Throws IOError if that fails or if the path
  /// has changed since the constructor; then the finished file keeps its temporary name.
  void commit();

private:
  std::string Path;
  std::string Temporary;
  TemporaryPath Listed;
  PathState Before;
  std::optional<OutputFile> File; ///< locked while it is open
};

/// Moves a finished file to its path. `before` as for PendingFile. Throws IOError, as
/// PendingFile::commit().
VTKTIPPIO_EXPORT void publishFile(
  const std::string& finished, const std::string& path, const PathState& before);

/// Throws IOError if an output folder's name ends like that of a mesh's or a table's file, such as
/// "mesh.vtu": programs would take the folder for a file of this format.
VTKTIPPIO_EXPORT void requireFolderName(const std::string& path);

/// The condition under which an existing folder may be replaced.
struct Replaceable
{
  const char* Name; ///< what the folder is called in messages, such as "partitioned mesh"
  std::function<bool(const std::string& path)> Is;
  /// Returns the files that make up such a folder, relative to it; throws IOError if that is
  /// unknown. A folder with any other file is not replaced.
  std::function<std::vector<std::string>(const std::string& path)> Files;
};

/// An output folder in a hidden work folder beside its path until commit(). Without commit() it is
/// removed with the work folder.
class VTKTIPPIO_EXPORT PendingFolder
{
public:
  /// Uses WorkFolder::beside(). Throws IOError if the parent folder is missing or not writable, or
  /// if the path holds something other than an empty folder or, if `replaceable` is given, a
  /// replaceable one.
  explicit PendingFolder(const std::string& path, const Replaceable* replaceable = nullptr)
    : PendingFolder(path, replaceable, false)
  {
  }
  /// Uses WorkFolder::lasting() instead: after keep() the folder stays, and a later run resumes
  /// from it. Files in the work folder beside the output are never published. Throws IOError also
  /// if another process uses the folder.
  static PendingFolder lasting(const std::string& path, const Replaceable* replaceable)
  {
    return { path, replaceable, true };
  }

  /// The folder to write to.
  const std::string& temporaryPath() const { return this->Temporary; }
  /// The work folder that contains it.
  WorkFolder& work() { return this->Work; }
  const std::string& workPath() const { return this->Work.path(); }

  /// Moves the folder to its path in one step and removes what was there. The caller must have
  /// synced its files for them to survive a crash. Throws IOError if that fails, or if what is at
  /// the path has changed or must not be replaced; then the finished folder stays in the work
  /// folder.
  void commit();

private:
  PendingFolder(const std::string& path, const Replaceable* replaceable, bool isLasting);
  PathState requireReplaceable(const std::string& path) const;
  std::string objectionTo(const std::string& folder) const;

  const Replaceable* const MayReplace;
  const std::string Path;
  const PathState Before;
  const bool IsLasting;
  WorkFolder Work;
  const std::string Temporary;
};

} // namespace tipp

#endif
