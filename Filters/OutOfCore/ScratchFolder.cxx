// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/ScratchFolder.h"

#include "Files/IOError.h"
#include "Files/TemporaryFiles.h"

#include <filesystem>
#include <vector>

#include <sys/stat.h>

namespace tipp
{

namespace fs = std::filesystem;

namespace
{

/// Not the folders around it: they are missing where the name is mistyped.
void makeFolder(const std::string& path)
{
  std::error_code failure;
  fs::create_directory(path, failure);
  if (failure)
  {
    throw IOError(path, "cannot be made (" + failure.message() + "); name another folder.");
  }
}

bool areOnOneDisk(const std::string& a, const std::string& b)
{
  struct stat ofA = {};
  struct stat ofB = {};
  return stat(a.c_str(), &ofA) == 0 && stat(b.c_str(), &ofB) == 0 && ofA.st_dev == ofB.st_dev;
}

void requireFree(const std::string& path, const std::string& folder, std::uint64_t needed)
{
  std::error_code failure;
  const fs::space_info space = fs::space(folder, failure);
  if (!failure && space.available < needed)
  {
    throw IOError(path,
      "needs about " + std::to_string(needed / 1000000 + 1) +
        " MB while it is made, and the disk of " + folder + " has " +
        std::to_string(space.available / 1000000) + " MB free; free space or name another disk.");
  }
}

} // namespace

ScratchFolder::ScratchFolder(const PendingFolder& mesh, const std::string& other)
  : Mesh(mesh.temporaryPath())
  , Work(mesh.workPath())
  , Folder(other.empty() ? this->Work : other + "/" + fs::path(this->Work).filename().string())
{
  if (this->Folder != this->Work)
  {
    makeFolder(other);
    claimWorkFolder(this->Folder, "Temporary files of the run that makes " + this->Mesh + "\n");
    this->Listed.list(this->Folder);
  }
  this->keep(mesh.isKept());
}

ScratchFolder::~ScratchFolder()
{
  if (!this->Kept)
  {
    this->remove();
  }
}

bool ScratchFolder::hasRun() const
{
  std::error_code ignored;
  return fs::exists(this->plan(), ignored) || !this->files(this->results()).empty();
}

void ScratchFolder::clear()
{
  this->removeFiles(this->results()); // without a plan they would tell of one that was lost
  clearWorkFolder(this->Work);
  makeFolder(this->Mesh);
  makeFolder(this->Mesh + "/pieces");
}

void ScratchFolder::requireSpace(
  const std::string& path, std::uint64_t mesh, std::uint64_t scratch) const
{
  if (areOnOneDisk(this->Work, this->Folder))
  {
    requireFree(path, this->Folder, mesh + scratch);
    return;
  }
  requireFree(path, this->Work, mesh);
  requireFree(path, this->Folder, scratch);
}

void ScratchFolder::remove()
{
  this->removeFiles(this->results());
  this->removeFiles(this->points());
  if (this->Folder != this->Work)
  {
    removeWorkFolder(this->Folder);
  }
}

/// Those in Folder whose paths begin like this, followed by a dot.
std::vector<std::string> ScratchFolder::files(const std::string& begin) const
{
  const std::string prefix = fs::path(begin).filename().string() + ".";
  std::vector<std::string> paths;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(this->Folder, ignored))
  {
    if (entry.path().filename().string().compare(0, prefix.size(), prefix) == 0)
    {
      paths.push_back(entry.path().string());
    }
  }
  return paths;
}

void ScratchFolder::removeFiles(const std::string& begin) const
{
  for (const std::string& path : this->files(begin))
  {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
}

} // namespace tipp
