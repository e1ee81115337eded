// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WorkFolder.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* randomLetters = "XXXXXX"; // mkdtemp() replaces them

bool hasFiles(const std::string& folder)
{
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, failure))
  {
    if (entry.symlink_status(failure).type() != fs::file_type::directory)
    {
      return true;
    }
  }
  return bool(failure); // also true if the folder could not be listed
}

std::string markOf(const std::string& folder)
{
  return folder + "/" + workFolderMark;
}

bool isMarked(const std::string& folder)
{
  struct stat state = {};
  return lstat(markOf(folder).c_str(), &state) == 0 && S_ISREG(state.st_mode);
}

/// Whether a folder is marked or holds no files.
bool isWorkFolder(const std::string& folder)
{
  return isMarked(folder) || !hasFiles(folder);
}

void mark(const std::string& folder, const std::string& purpose)
{
  try
  {
    const int descriptor =
      open(markOf(folder).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0)
    {
      failToWrite(folder);
    }
    OutputFile file(descriptor, folder);
    file.write(0, purpose.data(), purpose.size());
    file.close();
  }
  catch (const IOError&)
  {
    removeWorkFolder(folder);
    throw;
  }
}

/// Makes a folder and marks it, or reuses one that is empty or marked for the same purpose.
void claim(const std::string& folder, const std::string& purpose)
{
  std::error_code failure;
  const bool isNew = mkdir(folder.c_str(), 0777) == 0;
  if (!isNew && errno != EEXIST)
  {
    failToWrite(folder);
  }
  if (!fs::is_directory(folder, failure))
  {
    throw IOError(folder, "is a file where a folder for temporary files is to be; move it.");
  }
  if (!isNew && !isWorkFolder(folder))
  {
    throw IOError(folder,
      std::string(
        "is to hold temporary files, but it is there already with other files and without ") +
        workFolderMark + ", which marks the folders of runs; move it.");
  }
  if (!isMarked(folder))
  {
    mark(folder, purpose);
  }
  else if (!purpose.empty() && readTextFile(markOf(folder)) != purpose)
  {
    throw IOError(folder,
      "holds the temporary files of another run; name another folder, or remove it if that run "
      "is not to be resumed.");
  }
}

/// Removes the folders that makeUnique() has made and killed processes have left.
void clearLeftovers(const std::string& start)
{
  const fs::path path(start);
  const std::string prefix = path.filename().string();
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path(), failure))
  {
    const std::string name = entry.path().filename().string();
    const bool isNamedSo = name.size() == prefix.size() + std::strlen(randomLetters) &&
      name.compare(0, prefix.size(), prefix) == 0 &&
      entry.symlink_status(failure).type() == fs::file_type::directory;
    // Locked: its owner is still running.
    const int lock = isNamedSo ? lockPath(entry.path().string(), O_DIRECTORY) : -1;
    if (lock >= 0)
    {
      if (isWorkFolder(entry.path().string()))
      {
        removeWorkFolder(entry.path().string());
      }
      close(lock);
    }
  }
}

std::string hiddenPath(const std::string& output, const std::string& ending)
{
  const fs::path target = outputPath(output);
  return target.parent_path().string() + "/" + hiddenName(target.filename().string(), ending);
}

} // namespace

WorkFolder::WorkFolder(Kind kind, const std::string& where, const std::string& purpose)
{
  switch (kind)
  {
    case Kind::System:
      this->HasOnlyOurs = true;
      this->Path = (fs::temp_directory_path() / "tipp-").string() + randomLetters;
      if (!mkdtemp(this->Path.data()))
      {
        failToWrite(this->Path);
      }
      break;
    case Kind::Beside:
      this->makeUnique(hiddenPath(where, ".tmp."), where);
      break;
    case Kind::Lasting:
      this->openLasting(where);
      break;
    case Kind::Given:
    {
      // Missing parent folders are an error: the name may be mistyped.
      const std::string parent = fs::path(where).parent_path().string();
      std::error_code failure;
      fs::create_directory(parent, failure);
      if (failure)
      {
        throw IOError(parent, "cannot be made (" + failure.message() + "); name another folder.");
      }
      claim(where, purpose);
      this->Path = where;
      break;
    }
  }
  this->Listed.list(this->Path);
  this->keep(this->Kept);
}

std::string WorkFolder::lastingPath(const std::string& output)
{
  return hiddenPath(output, ".part");
}

void WorkFolder::makeUnique(const std::string& start, const std::string& output)
{
  clearLeftovers(start);
  std::string folder = start + randomLetters;
  if (!mkdtemp(folder.data()))
  {
    failToWrite(output);
  }
  this->Path = folder;
  this->Lock.emplace(lockPath(folder, O_DIRECTORY), folder);
  if (this->Lock->descriptor() < 0)
  {
    failToWrite(output);
  }
  claim(folder, "");
}

void WorkFolder::openLasting(const std::string& output)
{
  const std::string folder = lastingPath(output);
  const auto isStillThere = [&]
  {
    struct stat opened = {};
    struct stat named = {};
    return fstat(this->Lock->descriptor(), &opened) == 0 && stat(folder.c_str(), &named) == 0 &&
      opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
  };
  for (;;)
  {
    this->Kept = mkdir(folder.c_str(), 0777) != 0;
    if (this->Kept && errno != EEXIST)
    {
      failToWrite(output);
    }
    this->Lock.emplace(lockPath(folder, O_DIRECTORY), folder);
    if (this->Lock->descriptor() >= 0)
    {
      if (isStillThere())
      {
        break;
      }
    }
    else if (errno == EWOULDBLOCK)
    {
      throw IOError(output, "is being made by another process; wait for it or end it.");
    }
    else if (errno == ENOTDIR)
    {
      throw IOError(folder, "is a file where the work folder of the run is to be; move it.");
    }
    else if (errno != ENOENT) // ENOENT: its owner has just finished
    {
      failToWrite(folder);
    }
  }
  claim(folder, "");
  this->Path = folder;
}

WorkFolder::~WorkFolder()
{
  if (this->Kept)
  {
    return;
  }
  if (this->HasOnlyOurs)
  {
    std::error_code ignored;
    fs::remove_all(this->Path, ignored);
    return;
  }
  removeWorkFolder(this->Path);
}

void WorkFolder::keep(bool kept)
{
  this->Kept = kept;
  this->Listed.keep(kept);
}

void WorkFolder::giveUp()
{
  this->keep();
  removeFile(markOf(this->Path));
}

} // namespace tipp
