// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Las/LasHeader.h"
#include "Points/FilePoints.h"
#include "Points/PointStream.h"
#include "Vtk/VtkFiles.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

constexpr std::array<std::pair<const char*, const char*>, 6> usualNames = { { { "x", "y" },
  { "lon", "lat" }, { "longitude", "latitude" }, { "easting", "northing" }, { "lng", "lat" },
  { "long", "lat" } } };

std::optional<std::size_t> find(const std::vector<std::string>& names, const std::string& name)
{
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? std::nullopt : std::make_optional(std::size_t(at - names.begin()));
}

std::string listed(const std::vector<std::string>& names, std::size_t count)
{
  std::string list;
  for (const std::string& name : names)
  {
    list += (list.empty() ? "" : ", ") + name;
  }
  return names.empty() ? "0 to " + std::to_string(count - 1) : list;
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
  throw IOError(path, "has no column '" + wanted + "'; choose from " + listed(names, count) + ".");
}

} // namespace

std::optional<int> LasSelection::parseClass(const std::string& text)
{
  const auto number = wholeNumber<int>(text);
  return number && *number >= 0 && *number <= 255 ? number : std::nullopt;
}

ColumnChoice chooseColumns(const std::string& path, const std::vector<std::string>& names,
  std::size_t count, const PointOptions& options)
{
  if (count < 2)
  {
    throw IOError(path, "has a single column; x and y are needed.");
  }
  ColumnChoice choice;
  std::vector<std::string> lower;
  std::transform(names.begin(), names.end(), std::back_inserter(lower), lowerCase);
  for (const auto& [x, y] : usualNames)
  {
    const auto atX = find(lower, x);
    const auto atY = find(lower, y);
    if (atX && atY)
    {
      choice = { *atX, *atY };
      break;
    }
  }
  if (!options.X.empty())
  {
    choice.X = resolve(path, options.X, names, count);
  }
  if (!options.Y.empty())
  {
    choice.Y = resolve(path, options.Y, names, count);
  }
  if (choice.X == choice.Y)
  {
    throw IOError(path, "cannot give the same column as x and y; choose both.");
  }
  return choice;
}

namespace
{

void dropUnwanted(const PointOptions& options, PointTable& table)
{
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
  for (std::size_t i = 0; i < block.Columns.size(); ++i)
  {
    table.Columns.push_back({ file->columns()[i], std::move(block.Columns[i]) });
  }
  dropUnwanted(options, table);
  return table;
}

PointTable readAdcircPoints(const std::string& path)
{
  AdcircGrid grid = readAdcircGrid(path);
  PointTable table;
  table.XY = std::move(grid.XY);
  table.Columns.push_back({ "depth", std::move(grid.Depth) });
  return table;
}

/// Reads a text file, or one with fixed columns.
PointTable readWhole(const std::string& path, const PointOptions& options)
{
  if (options.Las.isGiven())
  {
    throw IOError(path, "has no classes and returns; these can be chosen in .las and .laz files.");
  }
  if (isTextPath(path) && conversionAdvice(path).empty())
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
  if (!isAdcircFile(path) && !isVtkFile(path))
  {
    refuseKind(path,
      "has no extension that tells a kind of point file; use .npy, .csv, .txt, .xyz (or these as "
      ".gz, .xz or .zst), .las, .laz, .14, .grd or one of VTK's.");
  }
  if (!options.X.empty() || !options.Y.empty())
  {
    throw IOError(path, "has fixed coordinates; columns can be chosen in .npy and text files.");
  }
  return isVtkFile(path) ? readVtkPoints(path) : readAdcircPoints(path);
}

} // namespace

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
  table.Crs = stream.crs();
  return table;
}

PointTable readPoints(const std::vector<std::string>& paths, const PointOptions& options)
{
  return paths.size() == 1 ? readPoints(paths[0], options)
                           : readAllPoints(*openPointStream(paths, options));
}

PointTable readPoints(const std::string& path, const PointOptions& options)
{
  const std::string extension = extensionOf(path);
  if (isLasExtension(extension) || options.Thin.isGiven())
  {
    return readAllPoints(*openPointStream({ path }, options));
  }
  if (extension == ".npy")
  {
    return readNpyPoints(path, options, 0, 1);
  }
  PointTable table = readWhole(path, options);
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
  if (paths.size() == 1 && extensionOf(paths[0]) == ".npy")
  {
    return readNpyPoints(paths[0], options, part, parts);
  }
  const bool isDivisible = std::all_of(paths.begin(), paths.end(),
    [](const std::string& path)
    { return extensionOf(path) == ".npy" || isLasExtension(extensionOf(path)); });
  if (!isDivisible)
  {
    return part == 0 ? readPoints(paths, options) : PointTable();
  }
  const auto stream = openPointStream(paths, options);
  const std::int64_t points = stream->divisible();
  stream->limitTo(shareBegin(points, part, parts), shareBegin(points, part + 1, parts));
  return readAllPoints(*stream);
}

} // namespace tipp
