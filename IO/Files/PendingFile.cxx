// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PendingFile.h"

#include "Files/IOError.h"
#include "Files/WorkFolder.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace tipp
{

namespace fs = std::filesystem;

PendingFile::PendingFile(const std::string& path)
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
  this->Before = PathState::of(this->Path);
  const std::string prefix =
    (target.parent_path() / hiddenName(target.filename(), ".")).string() + std::to_string(getpid());
  int descriptor = -1;
  for (int number = 0; descriptor < 0; ++number)
  {
    this->Temporary = prefix + (number == 0 ? "" : "-" + std::to_string(number)) + ".tmp";
    descriptor = open(this->Temporary.c_str(), O_WRONLY | O_CLOEXEC | O_CREAT | O_EXCL, 0666);
    if (descriptor < 0 && errno != EEXIST)
    {
      failToWrite(path);
    }
  }
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
  publish(finished, this->Path, this->Before, {});
  std::error_code ignored;
  fs::remove(finished, ignored); // what was there
  syncToDisk(fs::path(this->Path).parent_path().string());
}

} // namespace tipp
