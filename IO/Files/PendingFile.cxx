// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PendingFile.h"

#include "Files/IOError.h"
#include "Files/OutputPath.h"

#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace tipp
{

namespace fs = std::filesystem;

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
  const std::string name = "." + target.filename().string() + "." + std::to_string(getpid());
  this->Temporary = (target.parent_path() / (name + ".tmp")).string();
  this->Listed.list(this->Temporary);
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
  commitOutput(this->Path, [this] { moveIntoPlace(this->Temporary, this->Path); });
  this->Temporary.clear();
}

} // namespace tipp
