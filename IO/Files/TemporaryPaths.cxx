// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TemporaryPaths.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <regex>
#include <system_error>
#include <vector>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

struct PathRegistry
{
  std::mutex Mutex;
  struct PathUse
  {
    int Count = 0; ///< a path may be listed twice
    bool IsKept = false;
  };
  std::map<std::string, PathUse> Paths;
  /// A separate mutex, because a failing commit builds a message, which looks up these paths.
  std::mutex FinalsMutex;
  std::map<std::string, std::string> Finals; ///< final path of each temporary folder
  bool HasOutput = false;
};

/// Never destroyed: a signal may come while static objects are destroyed.
PathRegistry& listed()
{
  static auto* const all = new PathRegistry;
  return *all;
}

/// Other threads may still write into the folder. Only files that runs write are removed from it.
void removePath(const std::string& path)
{
  constexpr int mostTries = 100;
  std::error_code failure;
  for (int i = 0; i < mostTries && fs::exists(path, failure); ++i)
  {
    if (fs::is_directory(path, failure))
    {
      removeWorkFolder(path);
    }
    else
    {
      fs::remove(path, failure);
    }
  }
}

} // namespace

void TemporaryPath::list(const std::string& path)
{
  this->unlist();
  const std::lock_guard<std::mutex> lock(listed().Mutex);
  this->Path = path;
  ++listed().Paths[path].Count;
}

void TemporaryPath::unlist()
{
  if (this->Path.empty())
  {
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(listed().FinalsMutex);
    listed().Finals.erase(this->Shown);
  }
  const std::lock_guard<std::mutex> lock(listed().Mutex);
  if (--listed().Paths[this->Path].Count == 0)
  {
    listed().Paths.erase(this->Path);
  }
  this->Path.clear();
}

void TemporaryPath::showAs(const std::string& temporary, const std::string& final)
{
  const std::lock_guard<std::mutex> lock(listed().FinalsMutex);
  this->Shown = temporary;
  listed().Finals[temporary] = final;
}

void TemporaryPath::keep(bool kept)
{
  const std::lock_guard<std::mutex> lock(listed().Mutex);
  listed().Paths[this->Path].IsKept = kept;
}

TemporaryFile::TemporaryFile(const std::string& path)
  : Path(path)
{
  this->Listed.list(path);
}

TemporaryFile::~TemporaryFile()
{
  std::error_code ignored;
  fs::remove(this->Path, ignored);
}

std::string shownPath(const std::string& path)
{
  const std::lock_guard<std::mutex> lock(listed().FinalsMutex);
  const auto& finals = listed().Finals;
  std::string shown = path;
  // Temporary folders may be nested. The innermost sorts last; its final path lies in the outer
  // one.
  for (auto entry = finals.rbegin(); entry != finals.rend(); ++entry)
  {
    const auto& [temporary, final] = *entry;
    if (shown.compare(0, temporary.size(), temporary) == 0)
    {
      shown.replace(0, temporary.size(), final);
    }
  }
  return shown;
}

void commitOutput(const std::string& path, const std::function<void()>& move)
{
  const std::lock_guard<std::mutex> lock(listed().Mutex);
  move();
  const auto isWithin = [&path](const auto& entry)
  { return path.compare(0, entry.first.size() + 1, entry.first + "/") == 0; };
  const auto& all = listed().Paths;
  listed().HasOutput |= std::none_of(all.begin(), all.end(), isWithin);
}

EndedPaths endTemporaryPaths()
{
  listed().Mutex.lock(); // never released
  EndedPaths ended;
  ended.HasOutput = listed().HasOutput;
  for (const auto& [path, use] : listed().Paths)
  {
    ended.HasKept = ended.HasKept || use.IsKept;
    if (!use.IsKept)
    {
      removePath(path);
    }
  }
  return ended;
}

namespace
{

/// Whether runs write files of that name into their work folders: temporary files, and the
/// unfinished mesh or flat folder.
bool isOurs(const std::string& path)
{
  static const std::regex ours(
    "\\.(points|plan|piece|ranks)(\\.[^/]*)?"
    "|([^/]+/)+\\.(owners|points|cells|shared|borrowers|borrowed|ghosts)\\b.*"
    "|([^/]+/)+(index\\.json|tables\\.bin|mesh\\.pvtu|mesh\\.vtkhdf)"
    "|([^/]+/)+pieces/[0-9]{6,}\\.vtu(\\.next)?"
    "|([^/]+/)+[^/]+\\.npy"
    "|([^/]+/)*\\.[^/]+\\.tmp"
    "|([^/]+/)+\\.tipp-work",
    std::regex::optimize);
  return std::regex_match(path, ours);
}

void clear(const fs::path& folder, const std::string& prefix)
{
  std::error_code failure;
  std::vector<fs::directory_entry> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure))
  {
    entries.push_back(entry);
  }
  for (const fs::directory_entry& entry : entries)
  {
    const std::string name = prefix + entry.path().filename().string();
    const fs::file_type type = entry.symlink_status(failure).type();
    if (type == fs::file_type::directory)
    {
      clear(entry.path(), name + "/");
      fs::remove(entry.path(), failure); // fails if something is left in it
    }
    else if (type == fs::file_type::regular && isOurs(name))
    {
      fs::remove(entry.path(), failure);
    }
  }
}

} // namespace

std::string hashText(const std::string& text)
{
  std::uint64_t hash = 14695981039346656037U; // FNV-1a
  for (const char letter : text)
  {
    hash = (hash ^ std::uint8_t(letter)) * 1099511628211U;
  }
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

std::string hiddenName(const std::string& name, const std::string& ending)
{
  constexpr std::size_t longest = 255;
  constexpr std::size_t reserved = 24; // room for a suffix such as a process id
  if (name.size() + ending.size() + 1 + reserved <= longest)
  {
    return "." + name + ending;
  }
  return "." + name.substr(0, longest - reserved - 18 - ending.size()) + "." + hashText(name) +
    ending;
}

void clearWorkFolder(const std::string& folder)
{
  clear(folder, "");
}

void removeWorkFolder(const std::string& folder)
{
  clearWorkFolder(folder);
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
  {
    if (entry.path().filename() != workFolderMark)
    {
      return;
    }
  }
  fs::remove(folder + "/" + workFolderMark, ignored);
  fs::remove(folder, ignored);
}

} // namespace tipp
