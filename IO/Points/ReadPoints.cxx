// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Models/ModelMesh.h"
#include "Npy/NpyFile.h"
#include "Points/Longitudes.h"

#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

std::optional<std::size_t> find(const std::vector<std::string>& names, const std::string& name)
{
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? std::nullopt : std::make_optional(std::size_t(at - names.begin()));
}

std::size_t resolve(const std::string& path, const std::string& wanted,
  const std::vector<std::string>& names, std::size_t count)
{
  if (const auto named = find(names, wanted))
  {
    return *named;
  }
  const auto number = wholeNumber<std::size_t>(wanted);
  if (number && *number < count)
  {
    return *number;
  }
  throw IOError(path,
    "has no column '" + wanted + "'; choose from " +
      (names.empty() ? "0 to " + std::to_string(count - 1) : listOf(names)) + ".");
}

void requireNoSelection(const std::string& path, const PointOptions& options)
{
  if (options.Spacing > 0)
  {
    refuseSpacing(path);
  }
  if (options.Las.isGiven())
  {
    throw IOError(path, "has no classes and returns; these can be chosen in .las and .laz files.");
  }
}

void requireNoChoice(
  const std::string& path, const PointOptions& options, bool hasChoiceOfHeights = false)
{
  if (!options.X.empty() || !options.Y.empty() || (!options.Z.empty() && !hasChoiceOfHeights))
  {
    throw IOError(path, "has fixed coordinates; columns can be chosen in .npy and text files.");
  }
}

} // namespace

void refuseSpacing(const std::string& path)
{
  throw IOError(path,
    "is no COPC file, and only these have levels of different spacings; thin the points instead.");
}

bool isNoDataMark(double height)
{
  constexpr std::array<double, 12> marks = { -9999, -99999, -999999, -9999.99, -32768, -32767,
    1.70141e38, double(std::numeric_limits<float>::lowest()),
    double(std::numeric_limits<float>::max()), -3.402823e38, 1e20, 1e30 };
  return std::find(marks.begin(), marks.end(), height) != marks.end();
}

std::optional<int> LasSelection::parseClass(const std::string& text)
{
  const auto number = wholeNumber<int>(text);
  return number && *number >= 0 && *number <= 255 ? number : std::nullopt;
}

namespace
{

/// Chooses columns by their names, as far as the options do not.
ColumnChoice chooseByName(
  const std::string& path, const std::vector<std::string>& names, const PointOptions& options)
{
  ColumnChoice choice;
  try
  {
    const bool isChosen = !options.X.empty() && !options.Y.empty();
    if (!isChosen)
    {
      return requireCoordinates(names);
    }
    if (options.Z.empty())
    {
      findHeights(names, choice);
    }
    return choice;
  }
  catch (const std::invalid_argument& error)
  {
    throw IOError(path, std::string(error.what()) + "; choose the columns with --x, --y and --z.");
  }
}

} // namespace

ColumnChoice chooseColumns(const std::string& path, const std::vector<std::string>& names,
  std::size_t count, const PointOptions& options)
{
  if (count < 2)
  {
    throw IOError(path, "has a single column; x and y are needed.");
  }
  ColumnChoice choice =
    options.AsIs || names.empty() ? ColumnChoice() : chooseByName(path, names, options);
  const auto take = [&](const std::string& wanted, auto& column)
  {
    if (!wanted.empty())
    {
      column = resolve(path, wanted, names, count);
    }
  };
  take(options.X, choice.X);
  take(options.Y, choice.Y);
  const std::size_t next = std::max(choice.X, choice.Y) + 1;
  if (names.empty() && !options.AsIs && next < count)
  {
    choice.Z = next;
  }
  take(options.Z, choice.Z);
  choice.IsDepth = choice.IsDepth && options.Z.empty();
  if (choice.X == choice.Y)
  {
    throw IOError(path, "cannot give the same column as x and y; choose both.");
  }
  if (choice.Z == choice.X || choice.Z == choice.Y)
  {
    if (!options.Z.empty())
    {
      throw IOError(path, "cannot give the same column as z and as x or y; choose all three.");
    }
    choice.Z.reset();
  }
  return choice;
}

namespace
{

/// Whether a file is text, by its extension. "FILE.msh.gz" is not, although it is compressed.
bool isText(const std::string& path)
{
  const Opener opener = openerOf(path, Use::Points);
  return (opener == Opener::Text || opener == Opener::CompressedText) &&
    conversionAdvice(path).empty();
}

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
    return this->Width == 3
      ? std::vector<std::string>{ this->isThirdAsked() ? "z" : this->Names[this->third()] }
      : std::vector<std::string>();
  }

private:
  bool isThirdAsked() const { return this->Choice.Z == this->third(); }

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
    if (this->Load)
    {
      this->Table.reset();
    }
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

void clearNoData(const PointOptions& options, std::vector<double>& values)
{
  if (options.NoData)
  {
    std::replace(
      values.begin(), values.end(), *options.NoData, std::numeric_limits<double>::quiet_NaN());
  }
}

std::unique_ptr<FilePoints> openTable(PointTable table)
{
  return std::make_unique<TablePoints>(std::move(table), nullptr);
}

std::unique_ptr<FilePoints> openFilePoints(const std::string& path, const PointOptions& options)
{
  const std::int64_t generated = generatedCount(path);
  const Opener opener = generated > 0 ? Opener::None : openerOf(path, Use::Points);
  if (options.Region && (opener != Opener::Las || options.Wrap > 0))
  {
    PointOptions all = options;
    all.Region.reset();
    return keepRegion(openFilePoints(path, all), path, options);
  }
  if (opener != Opener::Las)
  {
    requireNoSelection(path, options);
  }
  if (generated > 0)
  {
    return openGeneratedPoints(generated, options.InSpace);
  }
  switch (opener)
  {
    case Opener::Las:
      requireNoChoice(path, options);
      return openLasPoints(path, options);
    case Opener::Npy:
      return std::make_unique<NpyPoints>(path, options);
    case Opener::Gdal:
      requireNoChoice(path, options, true);
      return openGisPoints(path, options);
    default:
      break;
  }
  if (isText(path))
  {
    return streamTextPoints(path, options);
  }
  const auto load = [path, options] { return readPoints(path, options); };
  return std::make_unique<TablePoints>(load(), load);
}

namespace
{

void dropUnwanted(const PointOptions& options, PointTable& table)
{
  for (PointTable::Column& column : table.Columns)
  {
    clearNoData(options, column.Values);
  }
  std::vector<PointTable::Column>& columns = table.Columns;
  columns.erase(
    std::remove_if(columns.begin(), columns.end(),
      [&options](const PointTable::Column& column) { return !options.wants(column.Name); }),
    columns.end());
}

/// The index of the first point of share `part` of `parts`.
std::int64_t shareBegin(std::int64_t points, int part, int parts)
{
  return points / parts * part + points % parts * part / parts;
}

/// Reads a share of an .npy file, without a copy.
PointTable readNpyPoints(const std::string& path, const PointOptions& options, int part, int parts)
{
  const std::unique_ptr<FilePoints> file = openFilePoints(path, options);
  const std::int64_t begin = shareBegin(file->divisible(), part, parts);
  PointBlock block;
  file->skip(begin);
  file->next(block, std::size_t(shareBegin(file->divisible(), part + 1, parts) - begin));
  PointTable table;
  table.XY = std::move(block.XY);
  wrapLongitudes(path, options.Wrap, table.XY);
  for (std::size_t i = 0; i < block.Columns.size(); ++i)
  {
    table.Columns.push_back({ file->columns()[i], std::move(block.Columns[i]) });
  }
  dropUnwanted(options, table);
  return table;
}

PointTable readNodes(const std::string& path)
{
  ModelMesh mesh = readModelMesh(path, ModelPart::Nodes);
  PointTable table;
  table.XY = std::move(mesh.XY);
  for (ModelMesh::Column& column : mesh.Columns)
  {
    table.Columns.push_back({ column.Name, std::move(column.Values) });
  }
  return table;
}

/// Reads a text file, or one with fixed columns.
PointTable readWhole(const std::string& path, const PointOptions& options)
{
  requireNoSelection(path, options);
  if (isText(path))
  {
    return readTextPoints(path, options);
  }
  if (path.compare(0, 8, "uniform:") == 0)
  {
    throw IOError(path,
      generatedCount(path) > 0
        ? "stands for points that are never all in memory; name an output that ends in .tipp."
        : "has no number of points after the colon, such as uniform:1000000.");
  }
  const Opener opener = openerOf(path, Use::Points);
  if (opener == Opener::None || (opener != Opener::Vtk && !isModelMesh(path)))
  {
    refuseKind(path,
      "has no extension that tells a kind of point file; use " +
        listFormats(Use::Points, " or one of VTK's") + ".");
  }
  requireNoChoice(path, options);
  return opener == Opener::Vtk ? readVtkPoints(path) : readNodes(path);
}

} // namespace

void append(const PointBlock& block, PointTable& table)
{
  table.XY.insert(table.XY.end(), block.XY.begin(), block.XY.end());
  for (std::size_t i = 0; i < table.Columns.size(); ++i)
  {
    const std::vector<double>& values = block.Columns.at(i);
    table.Columns[i].Values.insert(table.Columns[i].Values.end(), values.begin(), values.end());
  }
}

PointTable readAllPoints(PointStream& stream)
{
  constexpr std::size_t block = std::size_t(1) << 18;
  PointTable table;
  for (const std::string& name : stream.columns())
  {
    table.Columns.push_back({ name, {} });
  }
  // Untouched memory is not committed, but the system refuses reservations that it could never
  // commit.
  constexpr std::int64_t mostReserved = std::int64_t(1) << 26;
  const auto most = std::size_t(std::min(stream.most(), mostReserved));
  table.XY.reserve(2 * most);
  for (PointTable::Column& column : table.Columns)
  {
    column.Values.reserve(most);
  }
  forEachBlock(stream, block, [&table](const PointBlock& more) { append(more, table); });
  table.LeftOut = stream.leftOut();
  table.ThinnedOut = stream.thinnedOut();
  const ReferenceSystem system = stream.referenceSystem();
  table.Crs = system.Text;
  table.CrsProblem = system.Problem;
  table.Reports = stream.reports();
  table.Figures = stream.readFigures();
  return table;
}

PointTable readPoints(const std::vector<std::string>& paths, const PointOptions& options)
{
  return paths.size() == 1 ? readPoints(paths[0], options)
                           : readAllPoints(*openPointStream(paths, options));
}

PointTable readPoints(const std::string& path, const PointOptions& options)
{
  const Opener opener = openerOf(path, Use::Points);
  if (opener == Opener::Las || opener == Opener::Gdal || options.Thin.isGiven() || options.Region)
  {
    return readAllPoints(*openPointStream({ path }, options));
  }
  if (opener == Opener::Npy)
  {
    return readNpyPoints(path, options, 0, 1);
  }
  PointTable table = readWhole(path, options);
  wrapLongitudes(path, options.Wrap, table.XY);
  dropUnwanted(options, table);
  return table;
}

PointTable readPointsShare(
  const std::vector<std::string>& paths, const PointOptions& options, int part, int parts)
{
  if (options.Thin.isGiven())
  {
    return part == 0 ? readPoints(paths, options) : PointTable();
  }
  if (paths.size() == 1 && isOpenedBy(paths[0], Opener::Npy) && !options.Region)
  {
    return readNpyPoints(paths[0], options, part, parts);
  }
  const bool isDivisible = std::all_of(paths.begin(), paths.end(),
    [](const std::string& path) { return formatOf(path, Use::Divisible) != nullptr; });
  if (!isDivisible)
  {
    return part == 0 ? readPoints(paths, options) : PointTable();
  }
  const auto stream = openPointStream(paths, options);
  const std::int64_t points = stream->divisible();
  if (points < 0)
  {
    return part == 0 ? readAllPoints(*stream) : PointTable();
  }
  stream->limitTo(shareBegin(points, part, parts), shareBegin(points, part + 1, parts));
  return readAllPoints(*stream);
}

} // namespace tipp
