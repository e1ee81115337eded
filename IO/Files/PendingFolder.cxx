// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PendingFolder.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/OutputPath.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{

namespace fs = std::filesystem;

PendingFolder::PendingFolder(const std::string& path, const Replaceable* replaceable)
  : PendingFolder(path, replaceable, false)
{
}

PendingFolder::PendingFolder(
  const std::string& path, const Replaceable* replaceable, bool isLasting)
{
  std::error_code failure;
  const fs::path target = outputPath(path);
  const fs::path parent = target.parent_path();
  const bool mayBeThere = fs::is_directory(target, failure) &&
    (fs::is_empty(target, failure) || (replaceable && replaceable->Is(target.string())));
  if (fs::exists(target, failure) && !mayBeThere)
  {
    throw IOError(path,
      std::string("exists already") +
        (replaceable ? std::string(" and is no ") + replaceable->Name : "") +
        "; remove it or name another folder.");
  }
  this->Path = target.string();
  this->Parent = parent.string();
  const std::string name = target.filename().string();
  isLasting ? this->openLasting((parent / ("." + name + ".part")).string(), name)
            : this->makeTemporary("." + name + ".tmp.");
}

void PendingFolder::makeTemporary(const std::string& prefix)
{
  this->clearLeftovers(prefix);
  std::string name = this->Parent + "/" + prefix + "XXXXXX";
  if (!mkdtemp(name.data()))
  {
    throw IOError(this->Path, std::string("cannot be written (") + std::strerror(errno) + ").");
  }
  this->Temporary = name;
  this->Work = name;
  this->Listed.list(name);
  // mkdtemp() allows nobody else; an output is as open as other files.
  const mode_t mask = umask(0);
  umask(mask);
  std::error_code failure;
  fs::permissions(name, fs::perms(0777 & ~mask), failure);
  this->Lock = open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  flock(this->Lock, LOCK_EX | LOCK_NB);
}

void PendingFolder::openLasting(const std::string& folder, const std::string& name)
{
  const auto isStillThere = [&]
  {
    struct stat opened = {};
    struct stat named = {};
    return fstat(this->Lock, &opened) == 0 && stat(folder.c_str(), &named) == 0 &&
      opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
  };
  bool wasThere = false;
  for (;;)
  {
    wasThere = mkdir(folder.c_str(), 0777) != 0;
    if (wasThere && errno != EEXIST)
    {
      throw IOError(this->Path, std::string("cannot be written (") + std::strerror(errno) + ").");
    }
    this->Lock = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool isOurs = this->Lock >= 0 && flock(this->Lock, LOCK_EX | LOCK_NB) == 0;
    if (isOurs && isStillThere())
    {
      break;
    }
    const bool wasRemoved = isOurs || (this->Lock < 0 && errno == ENOENT);
    if (this->Lock >= 0)
    {
      close(this->Lock);
      this->Lock = -1;
    }
    if (!wasRemoved) // else its maker has just ended
    {
      throw IOError(this->Path, "is being made by another process; wait for it or end it.");
    }
  }
  this->Work = folder;
  this->Listed.list(folder);
  this->keep(wasThere);
  this->Temporary = folder + "/" + name;
  mkdir(this->Temporary.c_str(), 0777);
}

PendingFolder::~PendingFolder()
{
  if (!this->Work.empty() && !this->Kept)
  {
    std::error_code ignored;
    fs::remove_all(this->Work, ignored);
  }
  if (this->Lock >= 0)
  {
    close(this->Lock);
  }
}

void PendingFolder::clearLeftovers(const std::string& prefix) const
{
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(this->Parent, failure))
  {
    const std::string name = entry.path().filename().string();
    const bool ours = name.size() == prefix.size() + 6 &&
      name.compare(0, prefix.size(), prefix) == 0 && entry.is_directory(failure);
    const int folder = ours ? open(entry.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    // Its maker lives if it is locked.
    if (folder >= 0 && flock(folder, LOCK_EX | LOCK_NB) == 0)
    {
      fs::remove_all(entry.path(), failure);
    }
    if (folder >= 0)
    {
      close(folder);
    }
  }
}

void PendingFolder::exchange() const
{
  if (renameat2(AT_FDCWD, this->Temporary.c_str(), AT_FDCWD, this->Path.c_str(), RENAME_EXCHANGE) ==
    0)
  {
    return;
  }
  // Not every file system can exchange; then the old folder is moved out of the way first.
  const std::string old = this->Temporary + ".old";
  std::error_code failure;
  fs::rename(this->Path, old, failure);
  if (!failure)
  {
    fs::rename(this->Temporary, this->Path, failure);
    std::error_code ignored;
    fs::rename(old, failure ? this->Path : this->Temporary, ignored);
  }
  if (failure)
  {
    throw IOError(this->Path, "cannot be replaced (" + failure.message() + ").");
  }
}

void PendingFolder::commit()
{
  std::error_code failure;
  syncToDisk(this->Temporary);
  const bool replaces = fs::exists(this->Path, failure);
  commitOutput(
    this->Path, [&] { replaces ? this->exchange() : moveIntoPlace(this->Temporary, this->Path); });
  syncToDisk(this->Parent);
  if (replaces)
  {
    fs::remove_all(this->Temporary, failure); // the old one
  }
}

} // namespace tipp
