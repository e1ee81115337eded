// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PendingOutput.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/Platform.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{
namespace fs = std::filesystem;

PathState stateOf(const std::string& path)
{
  struct stat found = {};
  if (lstat(path.c_str(), &found) != 0)
  {
    return {};
  }
  PathState state{ { { std::uint64_t(found.st_dev), found.st_ino, 0, 0, 0 } } };
  if (S_ISREG(found.st_mode))
  {
    const timespec time = modificationTime(found);
    state.Values = { std::uint64_t(found.st_dev), found.st_ino, std::uint64_t(found.st_size),
      std::uint64_t(time.tv_sec), std::uint64_t(time.tv_nsec) };
  }
  return state;
}

namespace
{

[[noreturn]] void refuseToReplace(
  const std::string& temporary, const std::string& path, const std::string& reason)
{
  throw IOError(path, reason + ", so it is left alone; the finished output is " + temporary + ".");
}

[[noreturn]] void failToMove(const std::string& temporary, const std::string& path, int reason)
{
  refuseToReplace(
    temporary, path, std::string("cannot be replaced (") + std::strerror(reason) + ")");
}

bool isUnsupported(int reason)
{
  return reason == EINVAL || reason == ENOSYS || reason == ENOTSUP;
}

/// Moves to a path that must not exist.
void moveToFree(const std::string& temporary, const std::string& path)
{
  int reason = renamePath(temporary, path, Rename::Fails);
  if (isUnsupported(reason))
  {
    reason = stateOf(path).Values ? EEXIST : renamePath(temporary, path, Rename::Replaces);
  }
  if (reason == EEXIST)
  {
    refuseToReplace(temporary, path, "has appeared since the run began");
  }
  if (reason != 0)
  {
    failToMove(temporary, path, reason);
  }
}

/// Exchanges two paths. On file systems without an atomic exchange, the old output is first moved
/// aside.
int exchangePaths(const std::string& temporary, const std::string& path)
{
  const int reason = renamePath(temporary, path, Rename::Exchanges);
  if (!isUnsupported(reason))
  {
    return reason;
  }
  const std::string old = temporary + ".old";
  if (const int first = renamePath(path, old, Rename::Replaces))
  {
    return first;
  }
  if (const int second = renamePath(temporary, path, Rename::Replaces))
  {
    renamePath(old, path, Rename::Replaces);
    return second;
  }
  return renamePath(old, temporary, Rename::Replaces);
}

/// Moves a finished output to `path` in one step, and what was there before, if anything, to
/// `temporary`. Throws IOError and moves nothing if the path's state is no longer `before`, or if
/// `objection`, called with the path of what would be removed, returns a reason.
void publish(const std::string& temporary, const std::string& path, const PathState& before,
  const std::function<std::string(const std::string&)>& objection)
{
  if (!stateOf(path).Values)
  {
    moveToFree(temporary, path);
    return;
  }
  const auto reasonToStay = [&](const std::string& at) -> std::string
  {
    return !before.Values                   ? "has appeared since the run began"
      : stateOf(at).Values != before.Values ? "has been changed since the run began"
      : objection                           ? objection(at)
                                            : "";
  };
  std::string reason = reasonToStay(path);
  if (reason.empty())
  {
    const int failure = exchangePaths(temporary, path);
    if (failure != 0)
    {
      failToMove(temporary, path, failure);
    }
    // Another process may have written there in between.
    reason = reasonToStay(temporary);
    if (reason.empty())
    {
      return;
    }
    exchangePaths(temporary, path);
  }
  refuseToReplace(temporary, path, reason);
}

/// The suffix of a temporary file's name: a number, and a hash of the name. No file of a user ends
/// so by chance, so only leftovers are removed.
std::string ending(const std::string& start, const std::string& number)
{
  return number + "-" + hashText(start + number).substr(0, 8) + ".tmp";
}

/// Removes the files with this prefix that killed processes have left: those that no process has
/// locked.
void clearLeftovers(const fs::path& folder, const std::string& start)
{
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure))
  {
    const std::string name = entry.path().filename().string();
    const std::size_t digits = name.find_first_not_of("0123456789", start.size());
    const bool isOurs = name.compare(0, start.size(), start) == 0 && digits != std::string::npos &&
      name == start + ending(start, name.substr(start.size(), digits - start.size()));
    const int file = isOurs ? lockPath(entry.path().string(), O_NOFOLLOW) : -1;
    if (file >= 0)
    {
      fs::remove(entry.path(), failure);
      close(file);
    }
  }
}

/// Creates and locks the file; returns -1 if it cannot be created, for example because it exists.
/// Another process may remove it as a leftover before it is locked; then it is created again.
int makeLocked(const std::string& path)
{
  for (;;)
  {
    const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC | O_CREAT | O_EXCL, 0666);
    struct stat info = {};
    if (file < 0 || flock(file, LOCK_EX | LOCK_NB) != 0 ||
      (fstat(file, &info) == 0 && info.st_nlink > 0))
    {
      return file;
    }
    close(file);
  }
}

} // namespace

PendingFile::PendingFile(const std::string& path, const std::optional<PathState>& before)
{
  if (path.empty() || path.back() == '/')
  {
    throw IOError(path, "is the name of a folder, not an ordinary file; name a file to write.");
  }
  const fs::path target = outputPath(path);
  std::error_code failure;
  if (fs::exists(target, failure) && !fs::is_regular_file(target, failure))
  {
    throw IOError(path, "is not an ordinary file; name a file to write.");
  }
  this->Path = target.string();
  this->Before = before ? *before : stateOf(this->Path);
  const std::string start = hiddenName(target.filename(), ".");
  clearLeftovers(target.parent_path(), start);
  int descriptor = -1;
  for (int more = 0; descriptor < 0; ++more)
  {
    const std::string number = std::to_string(getpid()) + (more == 0 ? "" : std::to_string(more));
    this->Temporary = (target.parent_path() / (start + ending(start, number))).string();
    descriptor = makeLocked(this->Temporary);
    if (descriptor < 0 && errno != EEXIST)
    {
      failToWrite(path);
    }
  }
  this->Listed.list(this->Temporary);
  this->File.emplace(descriptor, path);
}

PendingFile::~PendingFile()
{
  if (!this->Temporary.empty())
  {
    removeFile(this->Temporary);
  }
}

void PendingFile::unlock() const
{
  flock(this->File->descriptor(), LOCK_UN);
}

void PendingFile::commit()
{
  this->File->sync();
  this->File->close();
  publishFile(std::exchange(this->Temporary, ""), this->Path, this->Before);
}

void publishFile(const std::string& finished, const std::string& path, const PathState& before)
{
  const std::string target = outputPath(path).string();
  commitOutput(target, [&] { publish(finished, target, before, {}); });
  removeFile(finished); // the previous file
  syncToDisk(fs::path(target).parent_path().string());
}

void requireFolderName(const std::string& path)
{
  const std::string extension = extensionOf(path);
  const bool isOfOthers = extension == ".npz" || extension == ".vtkhdf" || extension == ".vtm";
  if (isOfOthers || formatOf(path, ~unsigned(Use::WritesPieces)))
  {
    throw IOError(path,
      "would be a folder, though its name ends like a file's; give a name without " + extension +
        ", such as NAME.tipp.");
  }
}

PendingFolder::PendingFolder(
  const std::string& path, const Replaceable* replaceable, bool isLasting)
  : MayReplace(replaceable)
  , Path(outputPath(path).string())
  , Before(this->requireReplaceable(path))
  , IsLasting(isLasting)
  , Work(isLasting ? WorkFolder::lasting(this->Path) : WorkFolder::beside(this->Path))
  , Temporary(this->Work.path() + "/" + fs::path(this->Path).filename().string())
{
  if (!isLasting) // for a lasting one, messages show where the work is kept
  {
    this->Work.showAs(this->Temporary, this->Path);
  }
  const bool isMade = mkdir(this->Temporary.c_str(), 0777) == 0;
  const int reason = errno;
  std::error_code failure;
  if (!isMade && !fs::is_directory(this->Temporary, failure))
  {
    errno = reason;
    failToWrite(path);
  }
}

/// Returns the state of what is at the path. Throws IOError if that may not be replaced.
PathState PendingFolder::requireReplaceable(const std::string& path) const
{
  PathState state = stateOf(this->Path);
  const std::string objection = state.Values ? this->objectionTo(this->Path) : "";
  if (!objection.empty())
  {
    throw IOError(path, objection + "; remove it or name another folder.");
  }
  return state;
}

/// Returns why a folder must not be replaced; empty if it may be.
std::string PendingFolder::objectionTo(const std::string& folder) const
{
  std::error_code failure;
  const bool isFolder = fs::symlink_status(folder, failure).type() == fs::file_type::directory;
  if (isFolder && fs::is_empty(folder, failure))
  {
    return "";
  }
  if (!isFolder || !this->MayReplace || !this->MayReplace->Is(folder))
  {
    return std::string("exists already") +
      (this->MayReplace ? std::string(" and is no ") + this->MayReplace->Name : "");
  }
  std::vector<std::string> own;
  try
  {
    own = this->MayReplace->Files(folder);
  }
  catch (const IOError& error)
  {
    return std::string("exists already, but its files are not known (") + error.what() + ")";
  }
  std::sort(own.begin(), own.end());
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, failure))
  {
    const std::string name = entry.path().string().substr(folder.size() + 1);
    if (entry.symlink_status(failure).type() != fs::file_type::directory &&
      !std::binary_search(own.begin(), own.end(), name))
    {
      return "exists already and holds '" + name + "', which is no file of a " +
        this->MayReplace->Name;
    }
  }
  return failure ? "cannot be looked through (" + failure.message() + ")" : "";
}

void PendingFolder::commit()
{
  syncToDisk(this->Temporary);
  try
  {
    commitOutput(this->Path,
      [this]
      {
        publish(this->Temporary, this->Path, this->Before,
          [this](const std::string& folder) { return this->objectionTo(folder); });
      });
  }
  catch (const IOError&)
  {
    this->IsLasting ? this->Work.keep() : this->Work.giveUp();
    throw;
  }
  syncToDisk(fs::path(this->Path).parent_path().string());
  // The previous output is in the work folder now, and is removed with it.
}

} // namespace tipp
