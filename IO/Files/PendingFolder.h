// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPendingFolder_h
#define tippPendingFolder_h

#include "Files/OutputPath.h"
#include "Files/TemporaryPath.h"
#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// What a folder that is there already must be to be replaced.
struct Replaceable
{
  const char* Name; ///< as "partitioned mesh"
  std::function<bool(const std::string& path)> Is;
  /// The files that make up such a folder, relative to it; throws IOError if they are not known. A
  /// folder that has others is not replaced.
  std::function<std::vector<std::string>(const std::string& path)> Files;
};

/// An output folder in a hidden work folder beside its path until commit(). Without commit() it
/// goes away; what a killed process has left, the next one for the same path clears away. A work
/// folder is marked as made here, and only files that runs write are removed from it.
class VTKTIPPIO_EXPORT PendingFolder
{
public:
  /// Throws IOError if the path's own folder is missing or closed to us, or if there is something
  /// at the path other than an empty folder or, where it is given, what may be replaced.
  explicit PendingFolder(const std::string& path, const Replaceable* replaceable = nullptr);
  /// In a work folder whose name stays the same, ".NAME.part": that may be there already, from a
  /// run that did not end, and is then kept until keep(false); after keep() it stays. What is in it
  /// beside the output is never published. Throws IOError also if another process has it.
  static PendingFolder lasting(const std::string& path, const Replaceable* replaceable)
  {
    return { path, replaceable, true };
  }
  ~PendingFolder();
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;

  /// Write in here.
  const std::string& temporaryPath() const { return this->Temporary; }
  /// The work folder around it.
  const std::string& workPath() const { return this->Work; }
  bool isKept() const { return this->Kept; }
  void keep(bool kept = true)
  {
    this->Kept = kept;
    this->Listed.keep(kept);
  }

  /// Puts it in the path's place in one step and removes what was there. What is in it must be safe
  /// on the disk, if it is to be so afterwards. Throws IOError, also if what is at the path is not
  /// what was there at first or is not to be replaced; then the finished folder stays where it is.
  void commit();

private:
  PendingFolder(const std::string& path, const Replaceable* replaceable, bool isLasting);
  void makeTemporary(const std::string& prefix);
  void openLasting(const std::string& folder);
  void clearLeftovers(const std::string& prefix) const;
  std::string objectionTo(const std::string& folder) const;

  std::string Path;
  std::string Parent;
  const Replaceable* const MayReplace;
  PathState Before;
  std::string Temporary;
  std::string Work;
  TemporaryPath Listed;
  bool IsLasting;
  bool Kept = false;

  /// Of the work folder: released even if the constructor throws.
  struct FolderLock
  {
    FolderLock() = default;
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    ~FolderLock() { this->release(); }
    void release();

    int Descriptor = -1;
  };
  FolderLock Lock;
};

} // namespace tipp

#endif
