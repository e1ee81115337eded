// SPDX-License-Identifier: BSD-3-Clause
#include "Points/PointStream.h"

#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Points/FilePoints.h"

#include <array>
#include <future>
#include <utility>

#include <sys/stat.h>

namespace tipp
{

PointStream::~PointStream() = default;

namespace
{

std::string identityOf(const std::string& path)
{
  if (generatedCount(path) > 0)
  {
    return path + "\n";
  }
  struct stat status = {};
  if (stat(path.c_str(), &status) != 0)
  {
    throw IOError(path, "cannot be opened; check its name.");
  }
  return path + " " + std::to_string(status.st_size) + " " + std::to_string(status.st_mtim.tv_sec) +
    "." + std::to_string(status.st_mtim.tv_nsec) + "\n";
}

class FileSequence : public PointStream
{
public:
  FileSequence(const std::vector<std::string>& paths, const PointOptions& options)
  {
    for (const std::string& path : paths)
    {
      this->Paths.push_back(path);
      this->Identity += identityOf(path);
      this->Files.push_back(openFilePoints(path, options));
    }
    this->requireSameColumns();
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    while (this->At < this->Files.size())
    {
      block.XY.clear();
      block.Columns.clear();
      if (this->Files[this->At]->next(block, most))
      {
        block.First = this->Points;
        this->Points += std::int64_t(block.size());
        return true;
      }
      this->Files[this->At]->rewind(); // gives its memory back
      ++this->At;
    }
    this->requireSameColumns();
    return false;
  }

  void rewind() override
  {
    if (this->identityNow() != this->Identity)
    {
      throw IOError(this->Paths[0], "or another input has been changed meanwhile; start again.");
    }
    for (const auto& file : this->Files)
    {
      file->rewind();
    }
    this->At = 0;
    this->Points = 0;
  }

  std::vector<std::string> columns() const override { return this->Files[0]->columns(); }
  std::string identity() const override { return this->Identity; }

private:
  void requireSameColumns() const
  {
    for (std::size_t i = 1; i < this->Files.size(); ++i)
    {
      if (this->Files[i]->columns() != this->Files[0]->columns())
      {
        throw IOError(
          this->Paths[i], "has other columns than " + this->Paths[0] + "; give files of one kind.");
      }
    }
  }

  std::string identityNow() const
  {
    std::string identity;
    for (const std::string& path : this->Paths)
    {
      identity += identityOf(path);
    }
    return identity;
  }

  std::vector<std::string> Paths;
  std::vector<std::unique_ptr<FilePoints>> Files;
  std::string Identity;
  std::size_t At = 0;
  std::int64_t Points = 0;
};

} // namespace

std::unique_ptr<PointStream> openPointStream(
  const std::vector<std::string>& paths, const PointOptions& options)
{
  if (paths.empty())
  {
    throw IOError("There are no files of points; name one at least.");
  }
  return std::make_unique<FileSequence>(paths, options);
}

void forEachBlock(
  PointStream& points, std::size_t most, const std::function<void(PointBlock&)>& take)
{
  std::array<PointBlock, 2> blocks;
  points.rewind();
  const auto readInto = [&](std::size_t i)
  { return std::async(std::launch::async, [&, i] { return points.next(blocks[i], most); }); };
  std::future<bool> coming = readInto(0);
  for (std::size_t i = 0; coming.get(); i = 1 - i)
  {
    coming = readInto(1 - i);
    take(blocks[i]);
  }
}

} // namespace tipp
