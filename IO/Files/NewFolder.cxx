// SPDX-License-Identifier: BSD-3-Clause
#include "Files/NewFolder.h"

#include "Files/IOError.h"

#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace tipp
{

namespace fs = std::filesystem;

NewFolder::NewFolder(const std::string& path)
{
  // Without a slash at the end, which would leave no name.
  fs::path target = fs::path(path).lexically_normal();
  target = target.has_filename() ? target : target.parent_path();
  std::error_code failure;
  const fs::file_status status = fs::symlink_status(target, failure);
  if (fs::exists(status) && !(fs::is_directory(status) && fs::is_empty(target, failure)))
  {
    throw IOError(path, "exists already; remove it or name another folder.");
  }
  const fs::path around = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!target.has_filename() || !fs::is_directory(around, failure))
  {
    throw IOError(path, "the folder around it does not exist; create it or name another.");
  }
  this->Path = target.string();
  const std::string name = "." + target.filename().string() + "." + std::to_string(getpid());
  const fs::path temporary = around / (name + ".tmp");
  if (!fs::create_directory(temporary, failure))
  {
    throw IOError(path,
      "cannot be written (" + (failure ? failure.message() : temporary.string() + " exists") +
        "); change the permissions of the folder around it, or name another.");
  }
  this->Temporary = temporary.string();
}

NewFolder::~NewFolder()
{
  if (!this->Temporary.empty())
  {
    std::error_code ignored;
    fs::remove_all(this->Temporary, ignored);
  }
}

void NewFolder::commit()
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
