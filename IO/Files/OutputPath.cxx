// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputPath.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{
namespace fs = std::filesystem;

namespace
{

/// Follows links to the end, even if their target does not exist.
fs::path linkTarget(const std::string& path, fs::path target)
{
  std::error_code failure;
  constexpr int mostLinks = 40; // Linux's own limit
  for (int i = 0; fs::is_symlink(target, failure); ++i)
  {
    if (i == mostLinks)
    {
      throw IOError(path, "is a link that leads to itself; name another file.");
    }
    target = (target.parent_path() / fs::read_symlink(target, failure)).lexically_normal();
  }
  return target;
}

} // namespace

fs::path outputPath(const std::string& path)
{
  std::error_code failure;
  fs::path target = path.empty() ? fs::path() : fs::absolute(path);
  if (!target.has_filename())
  {
    target = target.parent_path(); // the path ended with a slash
  }
  target = linkTarget(path, target);
  // Resolve links among the folders first: "link/.." is not the link's own folder.
  const fs::path folder = fs::weakly_canonical(target.parent_path(), failure);
  target = folder / target.filename();
  if (!target.has_filename() || target.filename() == ".." || !fs::is_directory(folder, failure))
  {
    throw IOError(path, "its folder does not exist; create it or name another.");
  }
  if (target.filename() == ".")
  {
    target = folder;
  }
  if (access(folder.c_str(), W_OK) != 0)
  {
    throw IOError(path, "its folder cannot be written to; change its permissions or name another.");
  }
  struct stat ignored = {};
  if (lstat(target.c_str(), &ignored) != 0 && errno != ENOENT)
  {
    throw IOError(
      path, std::string("cannot be written (") + std::strerror(errno) + "); name another.");
  }
  return target;
}

PathState PathState::of(const std::string& path)
{
  PathState state;
  struct stat found = {};
  if (lstat(path.c_str(), &found) != 0)
  {
    return state;
  }
  state.Exists = true;
  state.Device = found.st_dev;
  state.Inode = found.st_ino;
  if (S_ISREG(found.st_mode))
  {
    state.Size = found.st_size;
    state.Seconds = found.st_mtim.tv_sec;
    state.Nanoseconds = found.st_mtim.tv_nsec;
  }
  return state;
}

bool PathState::operator==(const PathState& other) const
{
  return this->Exists == other.Exists && this->Device == other.Device &&
    this->Inode == other.Inode && this->Size == other.Size && this->Seconds == other.Seconds &&
    this->Nanoseconds == other.Nanoseconds;
}

namespace
{

[[noreturn]] void refuseToReplace(
  const std::string& temporary, const std::string& path, const std::string& reason)
{
  throw IOError(path, reason + ", so it is left alone; the finished output is " + temporary + ".");
}

[[noreturn]] void failToMove(const std::string& temporary, const std::string& path, int reason)
{
  refuseToReplace(
    temporary, path, std::string("cannot be replaced (") + std::strerror(reason) + ")");
}

bool isUnsupported(int reason)
{
  return reason == EINVAL || reason == ENOSYS || reason == ENOTSUP;
}

int renameAs(const std::string& from, const std::string& to, unsigned flags)
{
  return renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0 ? 0 : errno;
}

/// Moves to a path that must not exist.
void moveToFree(const std::string& temporary, const std::string& path)
{
  int reason = renameAs(temporary, path, RENAME_NOREPLACE);
  if (isUnsupported(reason))
  {
    reason = PathState::of(path).Exists ? EEXIST : renameAs(temporary, path, 0);
  }
  if (reason == EEXIST)
  {
    refuseToReplace(temporary, path, "has appeared since the run began");
  }
  if (reason != 0)
  {
    failToMove(temporary, path, reason);
  }
}

/// Exchanges two paths. On file systems without an atomic exchange, the old output is first moved
/// aside.
int exchangePaths(const std::string& temporary, const std::string& path)
{
  const int reason = renameAs(temporary, path, RENAME_EXCHANGE);
  if (!isUnsupported(reason))
  {
    return reason;
  }
  const std::string old = temporary + ".old";
  if (const int first = renameAs(path, old, 0))
  {
    return first;
  }
  if (const int second = renameAs(temporary, path, 0))
  {
    renameAs(old, path, 0);
    return second;
  }
  return renameAs(old, temporary, 0);
}

} // namespace

void publish(const std::string& temporary, const std::string& path, const PathState& before,
  const std::function<std::string(const std::string&)>& objection)
{
  const PathState now = PathState::of(path);
  if (!now.Exists)
  {
    moveToFree(temporary, path);
    return;
  }
  const auto reasonToStay = [&](const std::string& at) -> std::string
  {
    return !before.Exists           ? "has appeared since the run began"
      : PathState::of(at) != before ? "has been changed since the run began"
      : objection                   ? objection(at)
                                    : "";
  };
  std::string reason = reasonToStay(path);
  if (reason.empty())
  {
    const int failure = exchangePaths(temporary, path);
    if (failure != 0)
    {
      failToMove(temporary, path, failure);
    }
    // Another process may have written there in between.
    reason = reasonToStay(temporary);
    if (reason.empty())
    {
      return;
    }
    exchangePaths(temporary, path);
  }
  refuseToReplace(temporary, path, reason);
}

namespace
{

fs::path resolved(const std::string& path)
{
  std::error_code failure;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), failure);
  return whole.has_filename() ? whole : whole.parent_path();
}

/// The path that the output will have once links are resolved, even if the target does not exist.
fs::path finalPath(const std::string& output)
{
  try
  {
    return outputPath(output);
  }
  catch (const IOError&) // reported when the output is opened
  {
    return resolved(output);
  }
}

bool isWithin(const fs::path& path, const fs::path& folder)
{
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
    folder.end();
}

/// The files that a parallel VTK XML file (.pvtu ...) refers to: its "Source" attributes.
std::vector<std::string> piecesNamedBy(const std::string& path)
{
  const std::string text = readTextFile(path);
  const std::string label = "Source=\"";
  std::vector<std::string> pieces;
  for (std::size_t at = text.find(label); at != std::string::npos; at = text.find(label, at))
  {
    at += label.size();
    const std::string name = text.substr(at, text.find('"', at) - at);
    pieces.push_back((fs::path(path).parent_path() / name).string());
  }
  return pieces;
}

/// The file itself, or the files of a flat or partitioned mesh.
std::vector<std::string> filesOfInput(const std::string& path)
{
  std::error_code failure;
  std::vector<std::string> files;
  if (!fs::is_directory(path, failure))
  {
    const std::string name = fs::path(path).filename().string();
    const bool isIndex = name == "index.json" || name == "mesh.pvtu";
    if (isIndex)
    {
      files = filesOfInput(fs::absolute(path).parent_path().string());
    }
    files.push_back(path);
    if (!isIndex && extensionOf(path).rfind(".pvt", 0) == 0 && fs::is_regular_file(path, failure))
    {
      const std::vector<std::string> pieces = piecesNamedBy(path);
      files.insert(files.end(), pieces.begin(), pieces.end());
    }
    return files;
  }
  for (const char* const part : { "", "pieces", "point_data", "cell_data" })
  {
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(path) / part, failure))
    {
      if (entry.is_regular_file(failure))
      {
        files.push_back(entry.path().string());
      }
    }
  }
  return files;
}

/// Checks an output that exists; one that does not cannot be an input.
void requireNoInput(const std::string& output, const std::string& input)
{
  std::error_code failure;
  const bool isFolder = fs::is_directory(output, failure);
  const fs::path folder = resolved(output);
  for (const std::string& file : filesOfInput(input))
  {
    const bool isHit =
      isFolder ? isWithin(resolved(file), folder) : fs::equivalent(file, output, failure);
    if (isHit)
    {
      throw IOError(output,
        (isFolder ? "holds an input of the run, " + input
                  : std::string("is also an input of the run")) +
          ", so it cannot be the output; name another.");
    }
  }
}

} // namespace

void requireApart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs)
{
  std::error_code failure;
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const std::string& output = outputs[i];
    if (output.empty())
    {
      continue;
    }
    for (std::size_t j = 0; j < i; ++j)
    {
      const bool isSame = !outputs[j].empty() &&
        (isWithin(finalPath(output), finalPath(outputs[j])) ||
          isWithin(finalPath(outputs[j]), finalPath(output)) ||
          fs::equivalent(output, outputs[j], failure));
      if (isSame)
      {
        throw IOError(
          output, "is the same as the output " + outputs[j] + " or lies in it; name another.");
      }
    }
    if (!fs::exists(output, failure))
    {
      continue;
    }
    for (const std::string& input : inputs)
    {
      if (!input.empty())
      {
        requireNoInput(output, input);
      }
    }
  }
}

} // namespace tipp
