// SPDX-License-Identifier: BSD-3-Clause
#include "Points/FilePoints.h"

#include "Arrays/Random.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Las/LasHeader.h"
#include "Npy/NpyFile.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace tipp
{

namespace
{

/// The points of Distribution::Uniform with seed 1, generated block by block.
class GeneratedPoints : public FilePoints
{
public:
  GeneratedPoints(std::int64_t count, bool inSpace)
    : Count(count)
    , InSpace(inSpace)
  {
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const auto count = std::size_t(std::min(std::int64_t(most), this->Count - this->At));
    block.Columns.resize(this->InSpace ? 1 : 0);
    block.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      block.XY[2 * i] = this->Numbers.uniform();
      block.XY[2 * i + 1] = this->Numbers.uniform();
      for (std::vector<double>& z : block.Columns)
      {
        z[i] = this->Numbers.uniform();
      }
    }
    this->At += std::int64_t(count);
    return count > 0;
  }

  void rewind() override
  {
    this->Numbers = Random(1);
    this->At = 0;
  }

  std::int64_t divisible() const override { return this->Count; }

  void skip(std::int64_t points) override
  {
    for (std::int64_t i = 0; i < (this->InSpace ? 3 : 2) * points; ++i)
    {
      this->Numbers.bits(); // one number per coordinate; cheap compared with other work
    }
    this->At += points;
  }

  std::vector<std::string> columns() const override
  {
    return this->InSpace ? std::vector<std::string>{ "z" } : std::vector<std::string>();
  }

private:
  const std::int64_t Count;
  const bool InSpace;
  std::int64_t At = 0;
  Random Numbers{ 1 };
};

} // namespace

std::int64_t generatedCount(const std::string& name)
{
  const std::string start = "uniform:";
  if (name.compare(0, start.size(), start) != 0)
  {
    return 0;
  }
  const auto count = wholeNumber<std::int64_t>(name.substr(start.size()));
  constexpr std::int64_t most = std::int64_t(1) << 40;
  return count && *count > 0 && *count <= most ? *count : 0;
}

namespace
{

/// Points from an .npy table of two or three columns, named x, y and z, of float64 or float32.
class NpyPoints : public FilePoints
{
public:
  NpyPoints(const std::string& path, const PointOptions& options)
    : Reader(path)
    , Width(std::size_t(std::max<std::int64_t>(this->Reader.columns(), 0)))
  {
    if ((this->Width != 2 && this->Width != 3) || !this->Reader.isFloat())
    {
      throw IOError(
        path, "does not hold points; save n x 2 or n x 3 numbers of float64 or float32.");
    }
    this->Names = { "x", "y", "z" };
    this->Names.resize(this->Width);
    this->Choice = chooseColumns(path, this->Names, this->Width, options);
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    const std::size_t count = std::min(most, std::size_t(this->Reader.rows() - this->Row));
    block.Columns.resize(this->Width - 2);
    block.resize(count);
    if (this->Reader.type() == Scalar::Float32)
    {
      this->read<float>(block);
    }
    else if (this->Width == 2 && this->Choice.X == 0)
    {
      this->Reader.read(block.XY.data(), block.XY.size() * sizeof(double)); // as stored
    }
    else
    {
      this->read<double>(block);
    }
    this->Row += std::int64_t(count);
    return count > 0;
  }

  void rewind() override { this->skip(-this->Row); }
  std::int64_t divisible() const override { return this->Reader.rows(); }

  void skip(std::int64_t points) override
  {
    this->Row += points;
    this->Reader.seekRow(this->Row);
  }

  std::vector<std::string> columns() const override
  {
    return this->Width == 3 ? std::vector<std::string>{ this->Names[this->third()] }
                            : std::vector<std::string>();
  }

private:
  /// The index of the column that is neither x nor y, if there are three.
  std::size_t third() const { return 3 - this->Choice.X - this->Choice.Y; }

  template <typename Scalar>
  void read(PointBlock& block)
  {
    constexpr std::size_t rowsAtOnce = 1 << 15;
    const std::size_t count = block.size();
    const std::size_t third = this->third();
    double* const xy = block.XY.data();
    double* const further = this->Width == 3 ? block.Columns[0].data() : nullptr;
    std::vector<Scalar> rows(this->Width * std::min(rowsAtOnce, count));
    for (std::size_t first = 0; first < count; first += rowsAtOnce)
    {
      const std::size_t size = std::min(rowsAtOnce, count - first);
      this->Reader.read(rows.data(), size * this->Width * sizeof(Scalar));
      for (std::size_t i = 0; i < size; ++i)
      {
        const Scalar* const row = &rows[i * this->Width];
        xy[2 * (first + i)] = row[this->Choice.X];
        xy[2 * (first + i) + 1] = row[this->Choice.Y];
        if (further)
        {
          further[first + i] = row[third];
        }
      }
    }
  }

  NpyReader Reader;
  std::size_t Width;
  ColumnChoice Choice;
  std::vector<std::string> Names;
  std::int64_t Row = 0;
};

/// The points of a table. If `load` is given, it reads the table from a file that can only be read
/// as a whole; each pass calls it again, so that the table is not kept between passes.
class TablePoints : public FilePoints
{
public:
  TablePoints(PointTable table, std::function<PointTable()> load)
    : Load(std::move(load))
    , Names(table.names())
    , Table(std::move(table))
  {
    this->rewind();
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    if (!this->Table)
    {
      this->Table = this->Load();
    }
    const PointTable& table = *this->Table;
    const std::size_t end = this->At + std::min(most, table.size() - this->At);
    const auto copy = [&](const std::vector<double>& from, std::size_t width, auto& to)
    { to.assign(from.data() + width * this->At, from.data() + width * end); };
    copy(table.XY, 2, block.XY);
    block.Columns.resize(table.Columns.size());
    for (std::size_t i = 0; i < block.Columns.size(); ++i)
    {
      copy(table.Columns[i].Values, 1, block.Columns[i]);
    }
    this->At = end;
    return block.size() > 0;
  }

  void rewind() override
  {
    this->Load ? this->Table.reset() : void();
    this->At = 0;
  }

  std::int64_t divisible() const override { return this->Load ? -1 : this->most(); }
  void skip(std::int64_t points) override { this->At += std::size_t(points); }
  std::vector<std::string> columns() const override { return this->Names; }
  std::int64_t most() const override { return this->Load ? 0 : std::int64_t(this->Table->size()); }

private:
  const std::function<PointTable()> Load;
  const std::vector<std::string> Names;
  std::optional<PointTable> Table;
  std::size_t At = 0;
};

} // namespace

std::unique_ptr<FilePoints> openTable(PointTable table)
{
  return std::make_unique<TablePoints>(std::move(table), nullptr);
}

std::unique_ptr<FilePoints> openFilePoints(const std::string& path, const PointOptions& options)
{
  const std::int64_t generated = generatedCount(path);
  if (generated > 0)
  {
    return std::make_unique<GeneratedPoints>(generated, options.InSpace);
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
    return std::make_unique<NpyPoints>(path, options);
  }
  if (isTextPath(path) && conversionAdvice(path).empty())
  {
    return streamTextPoints(path, options);
  }
  const auto load = [path, options] { return readPoints(path, options); };
  return std::make_unique<TablePoints>(load(), load);
}

} // namespace tipp
