// SPDX-License-Identifier: BSD-3-Clause
#include "Points/FilePoints.h"

#include "Arrays/Random.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Las/LasHeader.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace tipp
{

NpyPointRows::NpyPointRows(const std::string& path, const PointOptions& options)
  : Reader(path)
  , Width(std::size_t(std::max<std::int64_t>(this->Reader.columns(), 0)))
{
  if ((this->Width != 2 && this->Width != 3) || !this->Reader.isFloat())
  {
    throw IOError(path, "does not hold points; save n x 2 or n x 3 numbers of float64 or float32.");
  }
  std::vector<std::string> names{ "x", "y", "z" };
  names.resize(this->Width);
  this->Choice = chooseColumns(path, names, this->Width, options);
  if (this->Width == 3)
  {
    this->Further.push_back(names[3 - this->Choice.X - this->Choice.Y]);
  }
}

void NpyPointRows::read(std::size_t count, double* xy, double* further)
{
  if (this->Reader.type() == NpyReader::Type::Float32)
  {
    this->readRows<float>(count, xy, further);
  }
  else if (this->Width == 2 && this->Choice.X == 0)
  {
    this->Reader.read(xy, 2 * count * sizeof(double)); // as stored
  }
  else
  {
    this->readRows<double>(count, xy, further);
  }
}

template <typename Scalar>
void NpyPointRows::readRows(std::size_t count, double* xy, double* further)
{
  constexpr std::size_t rowsAtOnce = 1 << 15;
  const std::size_t third = 3 - this->Choice.X - this->Choice.Y; // only used with three columns
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

PointTable readNpyPoints(const std::string& path, const PointOptions& options, int part, int parts)
{
  NpyPointRows file(path, options);
  const auto rowBefore = [&](int p)
  { return file.rows() / parts * p + file.rows() % parts * p / parts; };
  const auto rows = std::size_t(rowBefore(part + 1) - rowBefore(part));
  file.skip(rowBefore(part));
  PointTable table;
  table.XY.resize(2 * rows);
  for (const std::string& name : file.further())
  {
    table.Columns.push_back({ name, std::vector<double>(rows) });
  }
  file.read(
    rows, table.XY.data(), table.Columns.empty() ? nullptr : table.Columns[0].Values.data());
  return table;
}

void copyPoints(const PointTable& table, std::int64_t first, std::int64_t count, PointBlock& block)
{
  const auto copy = [&](const std::vector<double>& from, int width, std::vector<double>& to)
  { to.assign(from.begin() + width * first, from.begin() + width * (first + count)); };
  copy(table.XY, 2, block.XY);
  block.Columns.resize(table.Columns.size());
  for (std::size_t i = 0; i < block.Columns.size(); ++i)
  {
    copy(table.Columns[i].Values, 1, block.Columns[i]);
  }
}

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
    block.XY.resize(2 * count);
    block.Columns.resize(this->InSpace ? 1 : 0);
    for (std::vector<double>& z : block.Columns)
    {
      z.resize(count);
    }
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

std::unique_ptr<FilePoints> streamUniformPoints(std::int64_t count, bool inSpace)
{
  return std::make_unique<GeneratedPoints>(count, inSpace);
}

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

/// A file that can only be read as a whole, which the first call of next() does.
class WholeFilePoints : public FilePoints
{
public:
  WholeFilePoints(const std::string& path, const PointOptions& options)
    : Path(path)
    , Options(options)
  {
    this->load();
    this->Names = this->Table->names();
    this->rewind();
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    this->load();
    const std::size_t count = std::min(most, this->Table->size() - this->At);
    copyPoints(*this->Table, std::int64_t(this->At), std::int64_t(count), block);
    this->At += count;
    return count > 0;
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
    return streamUniformPoints(generated, options.InSpace);
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
