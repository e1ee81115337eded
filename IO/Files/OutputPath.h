// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutputPath_h
#define tippOutputPath_h

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace tipp
{

/// Where an output of that name is to be put: absolute, without a slash at the end, and where a
/// link leads, for a rename would replace the link. Throws IOError if the folder around it is
/// missing or not writable, or if the name is too long.
std::filesystem::path outputPath(const std::string& path);

/// Tells whether something else is at a path than before: another file or folder, or a file that
/// was written to.
struct PathState
{
  static PathState of(const std::string& path);
  bool operator==(const PathState& other) const;
  bool operator!=(const PathState& other) const { return !(*this == other); }

  bool Exists = false;
  std::uint64_t Device = 0;
  std::uint64_t Inode = 0;
  std::int64_t Size = 0; ///< of a file, as are the following
  std::int64_t Seconds = 0;
  std::int64_t Nanoseconds = 0;
};

/// Puts a finished output at `path` in one step, and what was there before, if anything, at
/// `temporary`. Throws IOError and leaves both where they are if something else is at the path than
/// `before`, or if `objection` to the removal of what is there, given its path, is not empty.
void publish(const std::string& temporary, const std::string& path, const PathState& before,
  const std::function<std::string(const std::string&)>& objection);

} // namespace tipp

#endif
