// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PendingFile.h"

#include "Files/IOError.h"

#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace tipp
{

namespace fs = std::filesystem;

PendingFile::PendingFile(const std::string& path)
{
  std::error_code failure;
  fs::path target(path);
  if (fs::exists(target, failure))
  {
    // A rename would replace a link, not what it points to.
    target = fs::canonical(target, failure);
    if (failure || !fs::is_regular_file(target, failure))
    {
      throw IOError(path, "is not an ordinary file; name a file to write.");
    }
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!target.has_filename() || !fs::is_directory(folder, failure))
  {
    throw IOError(path, "its folder does not exist; create it or name another.");
  }
  this->Path = target.string();
  const std::string name = "." + target.filename().string() + "." + std::to_string(getpid());
  this->Temporary = (folder / (name + ".tmp")).string();
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
  std::error_code failure;
  fs::rename(this->Temporary, this->Path, failure);
  if (failure)
  {
    throw IOError(this->Path, "cannot be written (" + failure.message() + ").");
  }
  this->Temporary.clear();
}

} // namespace tipp
