// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputPath.h"

#include "Files/IOError.h"

#include <system_error>

#include <unistd.h>

namespace tipp
{

namespace fs = std::filesystem;

fs::path outputPath(const std::string& path)
{
  std::error_code failure;
  fs::path target = path.empty() ? fs::path() : fs::absolute(path).lexically_normal();
  if (!target.has_filename())
  {
    target = target.parent_path(); // a slash at the end
  }
  if (fs::is_symlink(target, failure))
  {
    target = fs::weakly_canonical(target, failure);
  }
  const fs::path folder = target.parent_path();
  if (!target.has_filename() || !fs::is_directory(folder, failure))
  {
    throw IOError(path, "its folder does not exist; create it or name another.");
  }
  if (access(folder.c_str(), W_OK) != 0)
  {
    throw IOError(path, "its folder cannot be written to; change its permissions or name another.");
  }
  return target;
}

void moveIntoPlace(const std::string& temporary, const std::string& path)
{
  std::error_code failure;
  fs::rename(temporary, path, failure);
  if (failure)
  {
    throw IOError(path, "cannot be written (" + failure.message() + ").");
  }
}

} // namespace tipp
