// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutputPath_h
#define tippOutputPath_h

#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Returns the path that an output must be moved to: absolute, without a slash at the end, and with
/// links resolved, because a rename would replace the link. Throws IOError if the parent folder is
/// missing or not writable, or if the name is too long.
std::filesystem::path outputPath(const std::string& path);

/// The state of a path. If two differ, another file or folder is at the path, or the file was
/// written to.
struct PathState
{
  static PathState of(const std::string& path);
  bool operator==(const PathState& other) const;
  bool operator!=(const PathState& other) const { return !(*this == other); }

  bool Exists = false;
  std::uint64_t Device = 0;
  std::uint64_t Inode = 0;
  // The following members are set for files only.
  std::int64_t Size = 0; ///< in bytes
  std::int64_t Seconds = 0;
  std::int64_t Nanoseconds = 0;
};

/// Moves a finished output to `path` in one step, and what was there before, if anything, to
/// `temporary`. Throws IOError and moves nothing if the path's state is no longer `before`, or if
/// `objection`, called with the path of what would be removed, returns a reason.
void publish(const std::string& temporary, const std::string& path, const PathState& before,
  const std::function<std::string(const std::string&)>& objection);

/// Throws IOError if an output is also an input or another output, under any name or link, or is a
/// folder that holds one. Folders and .pvtu files stand for the files that they consist of; empty
/// names are ignored. Call it before any work.
VTKTIPPIO_EXPORT void requireApart(
  const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Returns the entry for the list of outputs that stands for a run's files in a scratch folder,
/// which may hold other outputs.
inline std::string scratchIn(const std::string& folder)
{
  return folder.empty() ? "" : folder + "/.scratch";
}

} // namespace tipp

#endif
