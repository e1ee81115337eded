// SPDX-License-Identifier: BSD-3-Clause
#include "Points/FilePoints.h"

#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Npy/NpyFile.h"
#include "Points/ColumnChoice.h"
#include "Points/ReadPoints.h"

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
  {
    this->Reader.emplace(path);
    this->Width = std::size_t(std::max<std::int64_t>(this->Reader->columns(), 0));
    if ((this->Width != 2 && this->Width != 3) || !this->Reader->isFloat())
    {
      throw IOError(
        path, "does not hold points; save n x 2 or n x 3 numbers of float64 or float32.");
    }
    std::vector<std::string> names{ "x", "y", "z" };
    names.resize(this->Width);
    this->Choice = chooseColumns(path, names, this->Width, options);
    if (this->Width == 3)
    {
      this->Names.push_back(names[3 - this->Choice.X - this->Choice.Y]);
    }
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const std::size_t count = std::min(most, std::size_t(this->Reader->rows() - this->Row));
    if (count == 0)
    {
      return false;
    }
    block.XY.resize(2 * count);
    block.Columns.assign(this->Names.size(), std::vector<double>(count));
    if (this->Reader->type() == NpyReader::Type::Float32)
    {
      this->readRows<float>(block, count);
    }
    else if (this->Width == 2 && this->Choice.X == 0)
    {
      this->Reader->read(block.XY.data(), block.XY.size() * sizeof(double));
    }
    else
    {
      this->readRows<double>(block, count);
    }
    this->Row += std::int64_t(count);
    return true;
  }

  void rewind() override
  {
    this->Reader.emplace(this->Path);
    this->Row = 0;
  }

  std::vector<std::string> columns() const override { return this->Names; }

private:
  template <typename Scalar>
  void readRows(PointBlock& block, std::size_t count)
  {
    constexpr std::size_t rowsAtOnce = 1 << 15;
    const std::size_t further = 3 - this->Choice.X - this->Choice.Y; // with three columns
    std::vector<Scalar> rows(this->Width * std::min(rowsAtOnce, count));
    for (std::size_t first = 0; first < count; first += rowsAtOnce)
    {
      const std::size_t size = std::min(rowsAtOnce, count - first);
      this->Reader->read(rows.data(), size * this->Width * sizeof(Scalar));
      for (std::size_t i = 0; i < size; ++i)
      {
        const Scalar* const row = &rows[i * this->Width];
        block.XY[2 * (first + i)] = row[this->Choice.X];
        block.XY[2 * (first + i) + 1] = row[this->Choice.Y];
        if (this->Width == 3)
        {
          block.Columns[0][first + i] = row[further];
        }
      }
    }
  }

  std::string Path;
  std::optional<NpyReader> Reader;
  std::size_t Width = 0;
  ColumnChoice Choice;
  std::vector<std::string> Names;
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
    const auto part = [&](const std::vector<double>& values, std::size_t width)
    {
      const auto begin = values.begin() + std::ptrdiff_t(width * this->At);
      return std::vector<double>(begin, begin + std::ptrdiff_t(width * count));
    };
    block.XY = part(this->Table->XY, 2);
    for (const PointTable::Column& column : this->Table->Columns)
    {
      block.Columns.push_back(part(column.Values, 1));
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
  if (extension == ".npy")
  {
    return std::make_unique<NpyFilePoints>(path, options);
  }
  return std::make_unique<WholeFilePoints>(path, options);
}

} // namespace tipp
