// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PendingFile.h"

#include "Files/IOError.h"
#include "Files/OutputPath.h"

#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{

namespace fs = std::filesystem;

namespace
{

/// Removes files of that name with a process's number, ".NAME.NUMBER.tmp", that no process has
/// locked.
void clearLeftovers(const fs::path& folder, const std::string& start)
{
  constexpr const char* end = ".tmp";
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure))
  {
    const std::string name = entry.path().filename().string();
    const std::size_t digits = name.find_first_not_of("0123456789", start.size());
    const bool isOurs = name.compare(0, start.size(), start) == 0 && digits > start.size() &&
      digits != std::string::npos && name.compare(digits, std::string::npos, end) == 0;
    const int file = isOurs ? open(entry.path().c_str(), O_RDONLY | O_CLOEXEC) : -1;
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

/// Makes and locks the file; -1 if it cannot be made. Another process may take it for a leftover
/// before it is locked.
int makeLocked(const std::string& path)
{
  for (;;)
  {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
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

PendingFile::PendingFile(const std::string& path)
{
  std::error_code failure;
  if (fs::exists(path, failure) && !fs::is_regular_file(path, failure))
  {
    throw IOError(path, "is not an ordinary file; name a file to write.");
  }
  if (!fs::path(path).has_filename())
  {
    throw IOError(path, "its folder does not exist; create it or name another.");
  }
  const fs::path target = outputPath(path);
  this->Path = target.string();
  const std::string start = "." + target.filename().string() + ".";
  clearLeftovers(target.parent_path(), start);
  const std::string name = start + std::to_string(getpid()) + ".tmp";
  this->Temporary = (target.parent_path() / name).string();
  this->Lock = makeLocked(this->Temporary);
  this->Listed.list(this->Temporary);
}

PendingFile::~PendingFile()
{
  if (!this->Temporary.empty())
  {
    std::error_code ignored;
    fs::remove(this->Temporary, ignored);
  }
  if (this->Lock >= 0)
  {
    close(this->Lock);
  }
}

void PendingFile::commit()
{
  commitOutput(this->Path, [this] { moveIntoPlace(this->Temporary, this->Path); });
  this->Temporary.clear();
}

} // namespace tipp
