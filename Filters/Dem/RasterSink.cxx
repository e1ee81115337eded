// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/RasterSink.h"

#include "Files/InputFile.h"
#include "Files/OutputFile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <utility>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

/// What the paths of files of samples at borders have after the run's own part.
constexpr const char* borderSuffix = ".border.";

/// A sample at the border of a part, with its bands' values behind it in files.
struct BorderSample
{
  std::int64_t Pixel;
  std::uint64_t Key;
};

/// The samples whose centres may lie from low to high, with a margin for roundings.
std::pair<std::int64_t, std::int64_t> samplesBetween(
  double low, double high, double origin, double size, double margin, std::int64_t count)
{
  const double last = double(count - 1);
  const double first = (low - origin) / size - 0.5 - margin;
  const double end = (high - origin) / size - 0.5 + margin;
  // In this order of arguments NaN gives no samples. Numbers below 0 are rounded to it.
  const auto ceiled = [](double value)
  { return std::int64_t(value) + (double(std::int64_t(value)) < value ? 1 : 0); };
  return { ceiled(std::min(std::max(0.0, first), last + 1)),
    end >= 0 ? std::int64_t(std::min(last, end)) : -1 };
}

/// How far roundings may move a coordinate, in samples.
double marginOf(double origin, double size, std::int64_t count)
{
  constexpr double rounding = 0x1p-50;
  const double largest = std::max(std::fabs(origin), std::fabs(origin + size * double(count)));
  return 1e-6 + rounding * largest / size;
}

} // namespace

/// The triangles of a part at one tile, and the samples at which they lie.
struct RasterSink::Tile
{
  std::vector<std::int32_t> Ids; ///< three a triangle
  std::int64_t FirstColumn = 0;
  std::int64_t LastColumn = -1;
  std::int64_t FirstRow = 0;
  std::int64_t LastRow = -1;

  void extend(std::int64_t column, std::int64_t lastColumn, std::int64_t row, std::int64_t lastRow)
  {
    const bool isFirst = this->LastColumn < 0;
    this->FirstColumn = isFirst ? column : std::min(this->FirstColumn, column);
    this->FirstRow = isFirst ? row : std::min(this->FirstRow, row);
    this->LastColumn = std::max(this->LastColumn, lastColumn);
    this->LastRow = std::max(this->LastRow, lastRow);
  }
};

/// What is sampled together.
struct RasterSink::Part
{
  /// Most triangles are at the tile of the one before.
  Tile& tileAt(std::int64_t row, std::int64_t column)
  {
    const Place place(row, column);
    if (place != this->LastPlace)
    {
      this->LastTile = &this->Tiles[place];
      this->LastPlace = place;
    }
    return *this->LastTile;
  }

  std::vector<double> XYZ;
  std::vector<std::vector<double>> Columns; ///< only those that bands need
  TerrainPoints Points;
  using Place = std::pair<std::int64_t, std::int64_t>; ///< row from the north, column
  std::map<Place, Tile> Tiles;
  Place LastPlace{ -1, -1 };
  Tile* LastTile = nullptr;
  std::string Border; ///< BorderSamples and their values
};

RasterSink::RasterSink(MakeSettings makeSettings, WriteRaster writeRaster)
  : Make(std::move(makeSettings))
  , Write(std::move(writeRaster))
{
}

std::uint64_t RasterSink::fileBytes(
  const Box2& bounds, const std::vector<std::string>& columns) const
{
  const TerrainSettings settings = this->Make(bounds, columns);
  return (settings.IsSingle ? sizeof(float) : sizeof(double)) *
    std::uint64_t(settings.Grid.Columns) * std::uint64_t(settings.Grid.Rows) *
    settings.Bands.Bands.size();
}

void RasterSink::findMargins()
{
  const RasterGrid& grid = this->Settings.Grid;
  this->Margins = { marginOf(grid.West, grid.Pixel[0], grid.Columns),
    marginOf(grid.South, grid.Pixel[1], grid.Rows) };
}

void RasterSink::begin(
  const Box2& bounds, const std::vector<std::string>& columns, const std::string& files)
{
  this->Settings = this->Make(bounds, columns);
  this->findMargins();
  this->Files = files;
  this->Store = std::make_unique<TileStore>(files + ".pixels", this->Settings.Grid,
    this->Settings.Bands.Bands.size(), this->Settings.IsSingle);
}

void RasterSink::take(const std::string& name, const double* rows, const PointRowLayout& layout,
  std::size_t points, const std::vector<TriangleRange>& triangles)
{
  const DemBands& bands = this->Settings.Bands;
  Part part;
  part.XYZ.resize(3 * points);
  for (std::size_t i = 0; i < points; ++i)
  {
    const double* const row = rows + i * layout.Words;
    part.XYZ[3 * i] = row[0];
    part.XYZ[3 * i + 1] = row[1];
    part.XYZ[3 * i + 2] = bands.HasElevation ? row[2 + bands.Elevation] : 0;
  }
  part.Columns.resize(layout.Words - 3);
  part.Points.XYZ = part.XYZ.data();
  part.Points.Count = std::int64_t(points);
  part.Points.Columns.resize(part.Columns.size());
  for (const DemBand& band : bands.Bands)
  {
    if (band.Is != DemBand::Kind::Column)
    {
      continue;
    }
    std::vector<double>& column = part.Columns[band.Column];
    if (column.empty())
    {
      column.resize(points);
      for (std::size_t i = 0; i < points; ++i)
      {
        column[i] = rows[i * layout.Words + 2 + band.Column];
      }
      part.Points.Columns[band.Column] = column.data();
    }
  }
  for (const TriangleRange& run : triangles)
  {
    for (std::size_t t = 0; t < run.Triangles; ++t)
    {
      this->addTriangle(part, run.Begin + 3 * t);
    }
  }
  for (auto& [place, tile] : part.Tiles)
  {
    this->sampleTile(part, tile);
    tile = Tile();
  }
  this->saveBorder(part, name);
}

void RasterSink::addTriangle(Part& part, const std::int32_t* corners) const
{
  const RasterGrid& grid = this->Settings.Grid;
  const double* const a = &part.XYZ[3 * std::size_t(corners[0])];
  const double* const b = &part.XYZ[3 * std::size_t(corners[1])];
  const double* const c = &part.XYZ[3 * std::size_t(corners[2])];
  const auto [column, lastColumn] = samplesBetween(std::min({ a[0], b[0], c[0] }),
    std::max({ a[0], b[0], c[0] }), grid.West, grid.Pixel[0], this->Margins[0], grid.Columns);
  const auto [row, lastRow] = samplesBetween(std::min({ a[1], b[1], c[1] }),
    std::max({ a[1], b[1], c[1] }), grid.South, grid.Pixel[1], this->Margins[1], grid.Rows);
  if (column > lastColumn || row > lastRow)
  {
    return;
  }
  const std::int64_t top = (grid.Rows - 1 - lastRow) / RasterTileSize;
  const std::int64_t bottom = (grid.Rows - 1 - row) / RasterTileSize;
  for (std::int64_t tileRow = top; tileRow <= bottom; ++tileRow)
  {
    const std::int64_t high = grid.Rows - 1 - tileRow * RasterTileSize;
    const std::int64_t low = std::max<std::int64_t>(high - RasterTileSize + 1, 0);
    for (std::int64_t i = column / RasterTileSize; i <= lastColumn / RasterTileSize; ++i)
    {
      Tile& tile = part.tileAt(tileRow, i);
      tile.Ids.insert(tile.Ids.end(), corners, corners + 3);
      const std::int64_t west = i * RasterTileSize;
      tile.extend(std::max(column, west), std::min(lastColumn, west + RasterTileSize - 1),
        std::max(row, low), std::min(lastRow, high));
    }
  }
}

void RasterSink::sampleTile(Part& part, const Tile& tile) const
{
  const RasterGrid& grid = this->Settings.Grid;
  SimplexMesh mesh;
  mesh.Points = part.XYZ.data();
  mesh.PointCount = part.Points.Count;
  mesh.Ids = tile.Ids.data();
  mesh.Cells = std::int64_t(tile.Ids.size() / 3);
  Lattice lattice = latticeOf(grid);
  lattice.Extent = { int(tile.FirstColumn), int(tile.LastColumn), int(tile.FirstRow),
    int(tile.LastRow), 0, 0 };
  SampledBands samples;
  std::vector<std::uint64_t> keys;
  samplePart(this->Settings, part.Points, mesh, lattice, samples, keys);
  const RasterWindow window{ tile.FirstColumn, tile.FirstRow,
    tile.LastColumn - tile.FirstColumn + 1, tile.LastRow - tile.FirstRow + 1 };
  std::vector<unsigned char> isInside(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    isInside[i] = isInsideKey(keys[i]) ? 1 : 0;
    if (isInside[i] == 0 && !isNoKey(keys[i]))
    {
      const std::int64_t column = window.Column + std::int64_t(i) % window.Columns;
      const std::int64_t row = window.Row + std::int64_t(i) / window.Columns;
      const BorderSample sample{ row * grid.Columns + column, keys[i] };
      part.Border.append(reinterpret_cast<const char*>(&sample), sizeof sample);
      for (const std::vector<double>& values : samples.Values)
      {
        part.Border.append(reinterpret_cast<const char*>(&values[i]), sizeof(double));
      }
    }
  }
  this->Store->set(window, isInside, samples.Values);
}

void RasterSink::saveBorder(const Part& part, const std::string& name) const
{
  if (!part.Border.empty())
  {
    OutputFile file(this->Files + borderSuffix + name);
    file.write(0, part.Border.data(), part.Border.size());
    file.close();
  }
}

/// Samples that no triangle contains, on the border of the whole mesh.
void RasterSink::answerBorders()
{
  const std::size_t bands = this->Settings.Bands.Bands.size();
  const std::size_t bytes = sizeof(BorderSample) + bands * sizeof(double);
  struct Entry
  {
    BorderSample Sample;
    std::size_t At; ///< of the values, among all
  };
  std::vector<Entry> entries;
  std::vector<double> values;
  const fs::path begin(this->Files + borderSuffix);
  const std::string prefix = begin.filename().string();
  for (const fs::directory_entry& entry : fs::directory_iterator(begin.parent_path()))
  {
    if (entry.path().filename().string().compare(0, prefix.size(), prefix) != 0)
    {
      continue;
    }
    const InputFile file(entry.path().string());
    std::string content(std::size_t(file.size()), '\0');
    file.read(0, content.data(), content.size());
    for (std::size_t at = 0; at + bytes <= content.size(); at += bytes)
    {
      entries.push_back({ {}, values.size() });
      std::memcpy(&entries.back().Sample, content.data() + at, sizeof(BorderSample));
      values.resize(values.size() + bands);
      std::memcpy(values.data() + entries.back().At, content.data() + at + sizeof(BorderSample),
        bands * sizeof(double));
    }
  }
  std::sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b)
    {
      return std::make_pair(a.Sample.Pixel, a.Sample.Key) <
        std::make_pair(b.Sample.Pixel, b.Sample.Key);
    });
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    if (i == 0 || entries[i].Sample.Pixel != entries[i - 1].Sample.Pixel)
    {
      this->Store->setIfMissing(entries[i].Sample.Pixel, values.data() + entries[i].At);
    }
  }
}

bool RasterSink::end(const std::function<bool(double)>& progress)
{
  this->answerBorders();
  return this->Write(
    this->Settings,
    [this](const RasterWindow& tile, std::vector<std::vector<double>>& values)
    { this->Store->read(tile, values); },
    progress);
}

} // namespace tipp
