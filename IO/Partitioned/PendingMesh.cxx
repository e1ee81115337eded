// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PendingMesh.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Partitioned/PartitionedMesh.h"

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

PendingMesh::PendingMesh(const std::string& path)
  : PendingMesh(path, false)
{
}

PendingMesh::PendingMesh(const std::string& path, bool lasting)
{
  std::error_code failure;
  fs::path target = fs::absolute(path).lexically_normal();
  if (!target.has_filename())
  {
    target = target.parent_path(); // a slash at the end
  }
  if (fs::is_symlink(target, failure))
  {
    // A rename would replace the link, not what it points to.
    target = fs::weakly_canonical(target, failure);
  }
  const bool taken = fs::exists(target, failure);
  if (taken &&
    !(fs::is_directory(target, failure) &&
      (isPartitionedMesh(target.string()) || fs::is_empty(target, failure))))
  {
    throw IOError(
      path, "is there already and is no partitioned mesh; remove it or name another folder.");
  }
  const fs::path parent = target.parent_path();
  if (!fs::is_directory(parent, failure))
  {
    throw IOError(path, "its folder does not exist; create it or name another.");
  }
  if (access(parent.c_str(), W_OK) != 0)
  {
    throw IOError(path, "its folder cannot be written to; change its permissions or name another.");
  }
  this->Path = target.string();
  this->Parent = parent.string();
  const std::string name = "." + target.filename().string();
  if (lasting)
  {
    this->openLasting(path, (parent / (name + ".part")).string());
    return;
  }
  this->clearLeftovers(name + ".tmp.");
  std::string temporary = (parent / (name + ".tmp.XXXXXX")).string();
  if (!mkdtemp(temporary.data()))
  {
    throw IOError(path, std::string("cannot be written (") + std::strerror(errno) + ").");
  }
  this->Temporary = temporary;
  // mkdtemp() allows nobody else; a mesh is as open as other files.
  const mode_t mask = umask(0);
  umask(mask);
  fs::permissions(temporary, fs::perms(0777 & ~mask), failure);
  this->Lock = open(temporary.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  flock(this->Lock, LOCK_EX | LOCK_NB);
}

void PendingMesh::openLasting(const std::string& path, const std::string& name)
{
  if (mkdir(name.c_str(), 0777) != 0 && errno != EEXIST)
  {
    throw IOError(path, std::string("cannot be written (") + std::strerror(errno) + ").");
  }
  this->Lock = open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (this->Lock < 0 || flock(this->Lock, LOCK_EX | LOCK_NB) != 0)
  {
    if (this->Lock >= 0)
    {
      close(this->Lock);
    }
    throw IOError(path, "is being made by another process; wait for it or end it.");
  }
  this->Temporary = name;
}

PendingMesh::~PendingMesh()
{
  if (!this->Temporary.empty() && !this->Kept)
  {
    std::error_code ignored;
    fs::remove_all(this->Temporary, ignored);
  }
  if (this->Lock >= 0)
  {
    close(this->Lock);
  }
}

void PendingMesh::clearLeftovers(const std::string& prefix) const
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

void PendingMesh::exchange() const
{
  if (renameat2(AT_FDCWD, this->Temporary.c_str(), AT_FDCWD, this->Path.c_str(), RENAME_EXCHANGE) ==
    0)
  {
    return;
  }
  // Not every file system can exchange; then the old mesh is moved out of the way first.
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

void PendingMesh::commit()
{
  std::error_code failure;
  syncToDisk(this->Temporary);
  const bool replaces = fs::exists(this->Path, failure);
  if (replaces)
  {
    this->exchange();
  }
  else
  {
    fs::rename(this->Temporary, this->Path, failure);
    if (failure)
    {
      throw IOError(this->Path, "cannot be written (" + failure.message() + ").");
    }
  }
  syncToDisk(this->Parent);
  if (replaces)
  {
    fs::remove_all(this->Temporary, failure); // the old mesh
  }
  this->Temporary.clear();
}

} // namespace tipp
