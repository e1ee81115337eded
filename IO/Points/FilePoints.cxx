// SPDX-License-Identifier: BSD-3-Clause
#include "Points/FilePoints.h"

#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Files/UnknownKind.h"
#include "Las/LasHeader.h"
#include "Las/LasPoints.h"
#include "Points/NpyPoints.h"
#include "Points/ReadPoints.h"
#include "Points/TextPoints.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

class NpyFilePoints : public FilePoints
{
public:
  NpyFilePoints(const std::string& path, const PointOptions& options)
    : Path(path)
    , Options(options)
  {
    this->rewind();
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const std::size_t count = std::min(most, std::size_t(this->File->rows() - this->Row));
    if (count == 0)
    {
      return false;
    }
    block.XY.resize(2 * count);
    block.Columns.resize(this->File->further().size());
    for (std::vector<double>& column : block.Columns)
    {
      column.resize(count);
    }
    this->File->read(
      count, block.XY.data(), block.Columns.empty() ? nullptr : block.Columns[0].data());
    this->Row += std::int64_t(count);
    return true;
  }

  void rewind() override
  {
    this->File.emplace(this->Path, this->Options);
    this->Row = 0;
  }

  std::int64_t divisible() const override { return this->File->rows(); }

  void skip(std::int64_t points) override
  {
    this->File->skip(points);
    this->Row += points;
  }

  std::vector<std::string> columns() const override { return this->File->further(); }

private:
  std::string Path;
  PointOptions Options;
  std::optional<NpyPointRows> File;
  std::int64_t Row = 0;
};

/// A file that only comes as a whole; it is read when its first point is wanted.
class WholeFilePoints : public FilePoints
{
public:
  WholeFilePoints(const std::string& path, const PointOptions& options)
    : Path(path)
    , Options(options)
  {
    this->load();
    for (const PointTable::Column& column : this->Table->Columns)
    {
      this->Names.push_back(column.Name);
    }
    this->rewind();
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    this->load();
    const std::size_t count = std::min(most, this->Table->size() - this->At);
    if (count == 0)
    {
      return false;
    }
    const auto take =
      [&](const std::vector<double>& values, std::size_t width, std::vector<double>& to)
    {
      const auto begin = values.begin() + std::ptrdiff_t(width * this->At);
      to.assign(begin, begin + std::ptrdiff_t(width * count));
    };
    take(this->Table->XY, 2, block.XY);
    block.Columns.resize(this->Table->Columns.size());
    for (std::size_t i = 0; i < block.Columns.size(); ++i)
    {
      take(this->Table->Columns[i].Values, 1, block.Columns[i]);
    }
    this->At += count;
    return true;
  }

  void rewind() override
  {
    this->Table.reset();
    this->At = 0;
  }

  std::vector<std::string> columns() const override { return this->Names; }

private:
  void load()
  {
    if (!this->Table)
    {
      this->Table = readPoints(this->Path, this->Options);
    }
  }

  std::string Path;
  PointOptions Options;
  std::vector<std::string> Names;
  std::optional<PointTable> Table;
  std::size_t At = 0;
};

} // namespace

std::unique_ptr<FilePoints> openFilePoints(const std::string& path, const PointOptions& options)
{
  const std::int64_t generated = generatedCount(path);
  if (generated > 0)
  {
    return generatePointsAsWanted(generated);
  }
  const std::string extension = extensionOf(path);
  if (isLasExtension(extension))
  {
    return openLasPoints(path, options);
  }
  if (options.Las.isGiven())
  {
    throw IOError(path, "has no classes and returns; these can be chosen in .las and .laz files.");
  }
  if (extension == ".npy")
  {
    return std::make_unique<NpyFilePoints>(path, options);
  }
  const std::string advice = conversionAdvice(path);
  if (!advice.empty())
  {
    throw IOError(path, advice);
  }
  if (isTextPath(path))
  {
    return streamTextPoints(path, options);
  }
  return std::make_unique<WholeFilePoints>(path, options);
}

} // namespace tipp
