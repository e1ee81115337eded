// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TemporaryPath.h"

#include "Files/WorkFolder.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

struct Listed
{
  std::mutex Mutex;
  std::map<std::string, int> Count; ///< a path may be listed twice
  std::map<std::string, bool> Kept;
  /// A separate mutex, because a failing commit builds a message, which looks up these paths.
  std::mutex FinalsMutex;
  std::map<std::string, std::string> Finals; ///< final path of each temporary folder
  bool HasOutput = false;
};

/// Never destroyed: a signal may come while static objects are destroyed.
Listed& listed()
{
  static auto* const all = new Listed;
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
  ++listed().Count[path];
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
  if (--listed().Count[this->Path] == 0)
  {
    listed().Count.erase(this->Path);
    listed().Kept.erase(this->Path);
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
  listed().Kept[this->Path] = kept;
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
  const std::map<std::string, int>& all = listed().Count;
  listed().HasOutput |= std::none_of(all.begin(), all.end(), isWithin);
}

EndedPaths endTemporaryPaths()
{
  listed().Mutex.lock(); // never released
  EndedPaths ended;
  ended.HasOutput = listed().HasOutput;
  for (const auto& [path, count] : listed().Count)
  {
    const auto kept = listed().Kept.find(path);
    if (kept != listed().Kept.end() && kept->second)
    {
      ended.HasKept = true;
      continue;
    }
    removePath(path);
  }
  return ended;
}

} // namespace tipp
