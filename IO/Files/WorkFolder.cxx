// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WorkFolder.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/TextFile.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <regex>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>

namespace tipp
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* markName = ".tipp-work";

/// Whether runs write files of that name into their work folders: temporary files, and the
/// unfinished mesh or flat folder.
bool isOurs(const std::string& path)
{
  static const std::regex ours(
    "\\.(points|plan|piece|ranks)(\\.[^/]*)?"
    "|[^/]+/\\.(homes|points|cells|shared|borrowers|borrowed|foreign)\\b.*"
    "|[^/]+/(index\\.json|tables\\.bin|mesh\\.pvtu)"
    "|[^/]+/pieces/[0-9]{6,}\\.vtu(\\.larger)?"
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

bool hasFiles(const std::string& folder)
{
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, failure))
  {
    if (entry.symlink_status(failure).type() != fs::file_type::directory)
    {
      return true;
    }
  }
  return bool(failure); // also true if the folder could not be listed
}

std::string markOf(const std::string& folder)
{
  return folder + "/" + markName;
}

bool isMarked(const std::string& folder)
{
  struct stat state = {};
  return lstat(markOf(folder).c_str(), &state) == 0 && S_ISREG(state.st_mode);
}

} // namespace

std::string hiddenName(const std::string& name, const std::string& ending)
{
  constexpr std::size_t longest = 255;
  constexpr std::size_t reserved = 24; // room for a suffix such as a process id
  if (name.size() + ending.size() + 1 + reserved <= longest)
  {
    return "." + name + ending;
  }
  std::uint64_t hash = 14695981039346656037U; // FNV-1a
  for (const char letter : name)
  {
    hash = (hash ^ std::uint8_t(letter)) * 1099511628211U;
  }
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return "." + name.substr(0, longest - reserved - 18 - ending.size()) + "." + digits.data() +
    ending;
}

void claimWorkFolder(const std::string& folder, const std::string& purpose)
{
  std::error_code failure;
  const bool isNew = mkdir(folder.c_str(), 0777) == 0;
  if (!isNew && errno != EEXIST)
  {
    failToWrite(folder);
  }
  if (!fs::is_directory(folder, failure))
  {
    throw IOError(folder, "is a file where a folder for temporary files is to be; move it.");
  }
  if (!isNew && !isWorkFolder(folder))
  {
    throw IOError(folder,
      std::string(
        "is to hold temporary files, but it is there already with other files and without ") +
        markName + ", which marks the folders of runs; move it.");
  }
  if (isMarked(folder))
  {
    if (!purpose.empty() && readTextFile(markOf(folder)) != purpose)
    {
      throw IOError(folder,
        "holds the temporary files of another run; name another folder, or remove it if that run "
        "is not to be resumed.");
    }
    return;
  }
  try
  {
    const int descriptor =
      open(markOf(folder).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0)
    {
      failToWrite(folder);
    }
    OutputFile mark(descriptor, folder);
    mark.write(0, purpose.data(), purpose.size());
    mark.close();
  }
  catch (const IOError&)
  {
    removeWorkFolder(folder);
    throw;
  }
}

bool isWorkFolder(const std::string& folder)
{
  return isMarked(folder) || !hasFiles(folder);
}

void unmarkWorkFolder(const std::string& folder)
{
  std::error_code ignored;
  fs::remove(markOf(folder), ignored);
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
    if (entry.path().filename() != markName)
    {
      return;
    }
  }
  unmarkWorkFolder(folder);
  fs::remove(folder, ignored);
}

} // namespace tipp
