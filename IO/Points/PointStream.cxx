// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Crs/StatedCodes.h"
#include "Files/IOError.h"
#include "Files/Platform.h"
#include "Files/TextFile.h"
#include "Points/Longitudes.h"

#include <algorithm>
#include <array>
#include <future>
#include <limits>
#include <utility>

namespace tipp
{

PointSource::~PointSource() = default;

namespace
{

std::string identityOf(const std::string& path)
{
  if (generatedCount(path) > 0)
  {
    return path + "\n";
  }
  struct stat status = {};
  if (stat(openablePath(path).c_str(), &status) != 0)
  {
    throw IOError(path, "cannot be opened; check its name.");
  }
  const timespec time = modificationTime(status);
  return path + " " + std::to_string(status.st_size) + " " + std::to_string(time.tv_sec) + "." +
    std::to_string(time.tv_nsec) + "\n";
}

class FileSequence : public PointStream
{
public:
  FileSequence(const std::vector<std::string>& paths, const PointOptions& options)
    : Wrap(options.Wrap)
  {
    for (const std::string& path : paths)
    {
      this->Paths.push_back(path);
      this->Identity += identityOf(path);
      this->Files.push_back(openFilePoints(path, options));
    }
    this->Identity += options.Las.text() + "\n";
    this->Identity += this->Wrap > 0 ? "wrap " + std::to_string(this->Wrap) + "\n" : "";
    this->Identity += options.X + "\n" + options.Y + "\n" + options.Z + "\n" + options.Layer + "\n";
    this->Identity += options.NoData ? exactText(*options.NoData) + "\n" : "";
    if (options.Region)
    {
      for (const double bound : vtkBoundsOf(*options.Region))
      {
        this->Identity += exactText(bound) + "\n";
      }
    }
    this->Identity += options.Spacing > 0 ? "spacing " + exactText(options.Spacing) + "\n" : "";
    this->NoData.NoData = options.NoData;
    this->NoData.Fields = options.Fields;
    for (const std::string& name : this->Files[0]->columns())
    {
      this->Kept.push_back(options.wants(name));
    }
    this->Names = this->columns();
    this->requireSameColumns();
    this->Crs = options.Crs;
    this->AnyCrs = options.AnyCrs;
    if (options.Crs.empty() && paths.size() > 1)
    {
      this->compareCrs();
    }
  }

  explicit FileSequence(std::unique_ptr<FilePoints> table)
    : Identity("table")
    , Kept(table->columns().size(), true)
  {
    this->Files.push_back(std::move(table));
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    while (this->At < this->Files.size() && this->Points < this->End)
    {
      block.resize(0);
      const auto left = std::uint64_t(this->End - this->Points);
      if (this->Files[this->At]->next(block, std::size_t(std::min<std::uint64_t>(most, left))))
      {
        this->finishColumns(block);
        if (this->Wrap > 0)
        {
          wrapLongitudes(this->Paths[this->At], this->Wrap, block.XY);
        }
        block.First = this->Points;
        this->Points += std::int64_t(block.size());
        return true;
      }
      this->Files[this->At]->rewind(); // frees its memory
      ++this->At;
    }
    this->requireSameColumns();
    return false;
  }

  void rewind() override
  {
    if (!this->areUnchanged())
    {
      throw IOError(this->Paths[0], "or another input has been changed meanwhile; start again.");
    }
    for (const auto& file : this->Files)
    {
      file->rewind();
    }
    this->At = 0;
    this->Points = 0;
    this->skipToFirst();
  }

  void needColumns(bool areNeeded) override
  {
    for (const auto& file : this->Files)
    {
      // Any value might be the one that stands for missing ones.
      file->needColumns(areNeeded || this->NoData.NoData.has_value());
    }
  }

  std::int64_t divisible() const override
  {
    std::int64_t points = 0;
    for (const auto& file : this->Files)
    {
      if (file->divisible() < 0)
      {
        return -1;
      }
      points += file->divisible();
    }
    return points;
  }

  std::int64_t most() const override
  {
    std::int64_t points = 0;
    for (const auto& file : this->Files)
    {
      if (file->most() <= 0)
      {
        return 0;
      }
      points += file->most();
    }
    return std::min(points, this->End - this->First);
  }

  void limitTo(std::int64_t first, std::int64_t end) override
  {
    this->First = first;
    this->End = end;
  }

  std::vector<std::string> columns() const override
  {
    const std::vector<std::string> all = this->Files[0]->columns();
    std::vector<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      if (this->Kept[i])
      {
        names.push_back(all[i]);
      }
    }
    return names;
  }

  std::int64_t leftOut() const override
  {
    std::int64_t points = 0;
    for (const auto& file : this->Files)
    {
      points += file->leftOut();
    }
    return points;
  }

  ReferenceSystem referenceSystem() const override
  {
    return this->Crs.empty() ? systemOf(this->Files) : describeCrs(this->Crs);
  }

  std::vector<TableReport> reports() const override
  {
    std::vector<TableReport> all = this->CrsReports;
    for (const auto& file : this->Files)
    {
      const std::vector<TableReport> reports = file->reports();
      all.insert(all.end(), reports.begin(), reports.end());
    }
    return all;
  }

  ReadFigures readFigures() const override
  {
    ReadFigures all;
    for (const auto& file : this->Files)
    {
      all.add(file->readFigures());
    }
    return all;
  }

  std::string identity() const override { return this->Identity; }

private:
  void skipToFirst()
  {
    while (this->Points < this->First && this->At < this->Files.size())
    {
      const std::int64_t here = this->Files[this->At]->divisible();
      const std::int64_t skipped = std::min(here, this->First - this->Points);
      this->Points += skipped;
      skipped < here ? this->Files[this->At]->skip(skipped) : static_cast<void>(++this->At);
    }
  }

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

  /// Returns the system of the files: that of the first that has one of heights, too, else of the
  /// first that has one. If no file has one, the first problem remains.
  static ReferenceSystem systemOf(const std::vector<std::unique_ptr<FilePoints>>& files)
  {
    ReferenceSystem system;
    for (const auto& file : files)
    {
      const ReferenceSystem own = file->referenceSystem();
      if (!own.Text.empty() &&
        (system.Text.empty() || (hasHeightSystem(own.Text) && !hasHeightSystem(system.Text))))
      {
        system = own;
      }
      else if (system.Text.empty() && system.Problem.empty())
      {
        system.Problem = own.Problem;
      }
    }
    return system;
  }

  /// Throws if files have different reference systems, or only reports it if that is allowed.
  /// Different spellings of one system are equal. A file without one, or without one of heights, is
  /// assumed to be in that of the others.
  void compareCrs()
  {
    const ReferenceSystem all = systemOf(this->Files);
    for (std::size_t i = 0; i < this->Files.size(); ++i)
    {
      const ReferenceSystem own = this->Files[i]->referenceSystem();
      if (!own.Text.empty() && !areSameCrs(own.Text, all.Text))
      {
        const std::string problem = "is in another coordinate reference system (" + inWords(own) +
          ") than the other files (" + inWords(all) +
          "); reproject it, or name the right system of all files with --crs.";
        if (!this->AnyCrs)
        {
          throw IOError(this->Paths[i], problem);
        }
        this->CrsReports.emplace_back().Path = this->Paths[i];
        this->CrsReports.back().Warnings.push_back(problem);
      }
    }
  }

  static std::string inWords(const ReferenceSystem& system)
  {
    return shownText(system.Words.empty() ? system.Text : system.Words);
  }

  /// Drops the columns that are not asked for, and clears values that stand for missing ones.
  void finishColumns(PointBlock& block) const
  {
    std::size_t next = 0;
    for (std::size_t i = 0; i < block.Columns.size(); ++i)
    {
      if (this->Kept[i] && next++ != i)
      {
        block.Columns[next - 1] = std::move(block.Columns[i]);
      }
    }
    block.Columns.resize(next);
    for (std::size_t i = 0; this->NoData.NoData && i < block.Columns.size(); ++i)
    {
      if (!this->NoData.Fields || !LasFields::isName(this->Names[i]))
      {
        clearNoData(this->NoData, block.Columns[i]);
      }
    }
  }

  bool areUnchanged() const
  {
    std::string identity;
    for (const std::string& path : this->Paths)
    {
      identity += identityOf(path);
    }
    return this->Identity.compare(0, identity.size(), identity) == 0;
  }

  const int Wrap = 0; ///< PointOptions::Wrap
  std::vector<std::string> Paths;
  std::vector<std::unique_ptr<FilePoints>> Files;
  std::string Identity;
  std::vector<bool> Kept;         ///< which of the files' columns are kept
  PointOptions NoData;            ///< only this option and Fields
  std::vector<std::string> Names; ///< of the columns that are kept
  std::size_t At = 0;
  std::int64_t Points = 0;
  std::int64_t First = 0;
  std::int64_t End = std::numeric_limits<std::int64_t>::max();
  std::string Crs; ///< that of the options
  bool AnyCrs = false;
  std::vector<TableReport> CrsReports;
};

} // namespace

std::unique_ptr<PointStream> openPointStream(
  const std::vector<std::string>& paths, const PointOptions& options)
{
  if (paths.empty())
  {
    throw IOError("There are no files of points; name one at least.");
  }
  if (!options.Thin.isGiven())
  {
    return std::make_unique<FileSequence>(paths, options);
  }
  PointOptions all = options;
  all.Thin = {};
  return thinPoints(std::make_unique<FileSequence>(paths, all), options.Thin);
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

std::unique_ptr<PointStream> streamTable(PointTable table, const Thinning& thinning)
{
  std::unique_ptr<PointStream> stream = std::make_unique<FileSequence>(openTable(std::move(table)));
  return thinning.isGiven() ? thinPoints(std::move(stream), thinning) : std::move(stream);
}

} // namespace tipp
