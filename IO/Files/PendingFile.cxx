// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PendingFile.h"

#include "Files/IOError.h"
#include "Files/WorkFolder.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
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

namespace
{

/// The suffix of a temporary file's name: a number, and a hash of the name that no user's file has
/// by chance, so that only leftovers are removed.
std::string ending(const std::string& start, const std::string& number)
{
  std::uint32_t hash = 2166136261U; // FNV-1a
  for (const char letter : start + number)
  {
    hash = (hash ^ std::uint8_t(letter)) * 16777619U;
  }
  char digits[9];
  std::snprintf(digits, sizeof(digits), "%08x", hash);
  return number + "-" + digits + ".tmp";
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
    const int file = isOurs ? open(entry.path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW) : -1;
    if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0)
    {
      fs::remove(entry.path(), failure);
    }
    if (file >= 0)
    {
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
  this->Before = before ? *before : PathState::of(this->Path);
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
    std::error_code ignored;
    fs::remove(this->Temporary, ignored);
  }
}

void PendingFile::commit()
{
  this->File->sync();
  this->File->close();
  const std::string finished = std::exchange(this->Temporary, "");
  commitOutput(this->Path, [&] { publish(finished, this->Path, this->Before, {}); });
  std::error_code ignored;
  fs::remove(finished, ignored); // the previous file
  syncToDisk(fs::path(this->Path).parent_path().string());
}

} // namespace tipp
