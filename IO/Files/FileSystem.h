// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFileSystem_h
#define tippFileSystem_h

#include "Files/IOError.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

namespace tipp
{

/// Whether there is a file or folder at the path; false if that cannot be found out.
inline bool pathExists(const std::string& path)
{
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// Removes a file if it is there. Errors are ignored.
inline void removeFile(const std::string& path)
{
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
}

/// Removes a file at the end of the scope.
struct RemovedFile
{
  explicit RemovedFile(const std::string& path)
    : Path(path)
  {
  }
  ~RemovedFile() { removeFile(this->Path); }
  RemovedFile(const RemovedFile&) = delete;
  RemovedFile& operator=(const RemovedFile&) = delete;

  const std::string Path;
};

/// Throws IOError, about the output `path`, if the disk of a folder has less free space than the
/// `needed` bytes.
inline void requireFreeSpace(
  const std::string& path, const std::string& folder, std::uint64_t needed)
{
  std::error_code failure;
  const std::filesystem::space_info space = std::filesystem::space(folder, failure);
  if (!failure && space.available < needed)
  {
    throw IOError(path,
      "needs about " + std::to_string(needed / 1000000 + 1) +
        " MB while it is made, and the disk of " + folder + " has " +
        std::to_string(space.available / 1000000) + " MB free; free space or name another disk.");
  }
}

} // namespace tipp

#endif
