// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/RasterSink.h"

#include "Dem/SurfaceSink.h"
#include "OutOfCore/ScratchFiles.h"
#include "Resample/Claims.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tipp
{
namespace
{

constexpr std::int64_t fewPixels = 4 * RasterTileSize * RasterTileSize;

/// The suffix of files with samples at borders, appended to the run's own path.
constexpr const char* borderSuffix = ".border.";

/// A pixel on the border of a part.
struct BorderPixel
{
  std::int64_t Pixel;
  std::uint64_t Key;
};

/// The range of samples whose centres may lie in [low, high], with a margin for rounding.
std::pair<std::int64_t, std::int64_t> samplesBetween(
  double low, double high, double origin, double size, double margin, std::int64_t count)
{
  const double last = double(count - 1);
  const double first = (low - origin) / size - 0.5 - margin;
  const double end = (high - origin) / size - 0.5 + margin;
  // With this order of arguments NaN gives no samples. Negative numbers become 0.
  const auto ceiled = [](double value)
  { return std::int64_t(value) + (double(std::int64_t(value)) < value ? 1 : 0); };
  return { ceiled(std::min(std::max(0.0, first), last + 1)),
    end >= 0 ? std::int64_t(std::min(last, end)) : -1 };
}

/// How far rounding may move a coordinate, in samples.
double marginOf(double origin, double size, std::int64_t count)
{
  constexpr double rounding = 0x1p-50;
  const double largest = std::max(std::fabs(origin), std::fabs(origin + size * double(count)));
  return 1e-6 + rounding * largest / size;
}

} // namespace

/// A tile of samples, and the triangles of a part that may meet it.
struct RasterSink::Tile
{
  std::vector<std::int32_t> Ids; ///< three point indices per triangle
  RasterWindow Window;

  void extend(const RasterWindow& added)
  {
    RasterWindow& window = this->Window;
    if (window.Columns == 0)
    {
      window = added;
      return;
    }
    const std::int64_t right =
      std::max(window.Column + window.Columns, added.Column + added.Columns);
    const std::int64_t top = std::max(window.Row + window.Rows, added.Row + added.Rows);
    window.Column = std::min(window.Column, added.Column);
    window.Row = std::min(window.Row, added.Row);
    window.Columns = right - window.Column;
    window.Rows = top - window.Row;
  }
};

/// A part of the mesh whose triangles are sampled together.
struct RasterSink::Part
{
  /// Returns a tile, created if necessary. Most triangles are in the same tile as the previous one.
  Tile& tileAt(std::int64_t number)
  {
    if (number != this->LastNumber)
    {
      this->LastTile = &this->Tiles[number];
      this->LastNumber = number;
    }
    return *this->LastTile;
  }

  std::vector<double> XYZ;
  std::vector<std::vector<double>> Values; ///< of the columns that bands need
  TerrainColumns Columns;
  std::map<std::int64_t, Tile> Tiles; ///< by number
  std::int64_t LastNumber = -1;
  Tile* LastTile = nullptr;
  std::int64_t Assigned = 0; ///< triangles in all tiles
  std::vector<BorderPixel> Border;
  std::vector<double> BorderValues; ///< for each BorderPixel the values of its bands
};

RasterSink::RasterSink(
  MakeSettings makeSettings, WriteRaster writeRaster, const RasterDescription* encoding)
  : Make(std::move(makeSettings))
  , Write(std::move(writeRaster))
  , Encoding(encoding ? std::make_optional(*encoding) : std::nullopt)
{
}

std::uint64_t RasterSink::fileBytes(
  const Box2& bounds, const std::vector<std::string>& columns) const
{
  const TerrainSettings settings = this->Make(bounds, columns);
  const double bytes = double(settings.IsSingle ? sizeof(float) : sizeof(double)) *
    double(settings.Grid.Columns) * double(settings.Grid.Rows) *
    double(settings.Bands.Bands.size());
  constexpr double most = 0x1p60; // larger than any disk
  return std::uint64_t(std::min(bytes, most));
}

void RasterSink::begin(
  const Box2& bounds, const std::vector<std::string>& columns, const std::string& files)
{
  this->Settings = this->Make(bounds, columns);
  const RasterGrid& grid = this->Settings.Grid;
  this->Margins = { marginOf(grid.West, grid.Pixel[0], grid.Columns),
    marginOf(grid.South, grid.Pixel[1], grid.Rows) };
  this->Files = files;
  FinishTile finish;
  if (this->Encoding)
  {
    finish = [this](const RasterWindow& window, std::vector<std::vector<double>>& values)
    {
      FinishedTile tile;
      tile.Filled = fillTile(this->Settings.Bands, values);
      tile.Encoded = encodeTile(*this->Encoding, window, pointersTo(values));
      return tile;
    };
  }
  this->Store = std::make_unique<TileStore>(files + ".pixels", grid,
    this->Settings.Bands.Bands.size(), this->Settings.IsSingle, std::move(finish));
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
  part.Values.resize(layout.Words - 3);
  part.Columns.resize(part.Values.size());
  for (const DemBand& band : bands.Bands)
  {
    if (band.Is != DemBand::Kind::Column)
    {
      continue;
    }
    std::vector<double>& column = part.Values[band.Column];
    if (column.empty())
    {
      column.resize(points);
      for (std::size_t i = 0; i < points; ++i)
      {
        column[i] = rows[i * layout.Words + 2 + band.Column];
      }
      part.Columns[band.Column] = column.data();
    }
  }
  // Most triangles of a part are adjacent, so they fill most of its window. Triangles at the border
  // of the point set may be long.
  std::int64_t count = 0;
  for (const TriangleRange& run : triangles)
  {
    count += std::int64_t(run.Triangles);
  }
  Tile all;
  all.Window = this->windowOf(boundsOf(rows, layout.Words, points));
  const auto bandCount = std::int64_t(bands.Bands.size());
  if (all.Window.Columns * all.Window.Rows * bandCount > fewPixels + 2 * count)
  {
    this->sampleByTile(part, triangles);
  }
  else if (all.Window.Columns > 0)
  {
    all.Ids.reserve(3 * std::size_t(count));
    for (const TriangleRange& run : triangles)
    {
      all.Ids.insert(all.Ids.end(), run.Begin, run.Begin + 3 * run.Triangles);
    }
    this->sampleTile(part, all);
  }
  if (!part.Border.empty())
  {
    writeCheckedFile(this->Files + borderSuffix + name,
      [&part](SaveArchive& archive) { archive(part.Border, part.BorderValues); });
  }
}

/// Assigns each triangle to every tile that it may meet. Long triangles meet many tiles, so
/// whenever the lists are full, they are sampled before the next triangles are assigned.
void RasterSink::sampleByTile(Part& part, const std::vector<TriangleRange>& triangles) const
{
  const auto sampleAll = [&]
  {
    for (const auto& [number, tile] : part.Tiles)
    {
      this->sampleTile(part, tile);
    }
    part.Tiles.clear();
    part.LastNumber = -1;
    part.Assigned = 0;
  };
  const std::int64_t mostAssigned = fewPixels + 4 * std::int64_t(part.XYZ.size() / 3);
  for (const TriangleRange& run : triangles)
  {
    for (std::size_t t = 0; t < run.Triangles; ++t)
    {
      this->addTriangle(part, run.Begin + 3 * t);
      part.Assigned > mostAssigned ? sampleAll() : void();
    }
  }
  sampleAll();
}

/// The window of samples that may lie in a box; empty if there are none.
RasterWindow RasterSink::windowOf(const Box2& box) const
{
  const RasterGrid& grid = this->Settings.Grid;
  const auto [column, lastColumn] =
    samplesBetween(box.xmin, box.xmax, grid.West, grid.Pixel[0], this->Margins[0], grid.Columns);
  const auto [row, lastRow] =
    samplesBetween(box.ymin, box.ymax, grid.South, grid.Pixel[1], this->Margins[1], grid.Rows);
  return column > lastColumn || row > lastRow
    ? RasterWindow()
    : RasterWindow{ column, row, lastColumn - column + 1, lastRow - row + 1 };
}

void RasterSink::addTriangle(Part& part, const std::int32_t* corners) const
{
  const double* const a = &part.XYZ[3 * std::size_t(corners[0])];
  const double* const b = &part.XYZ[3 * std::size_t(corners[1])];
  const double* const c = &part.XYZ[3 * std::size_t(corners[2])];
  const RasterWindow window =
    this->windowOf({ std::min({ a[0], b[0], c[0] }), std::min({ a[1], b[1], c[1] }),
      std::max({ a[0], b[0], c[0] }), std::max({ a[1], b[1], c[1] }) });
  forTiles(this->Settings.Grid, window,
    [&](std::int64_t number, const RasterWindow& inTile)
    {
      Tile& tile = part.tileAt(number);
      tile.Ids.insert(tile.Ids.end(), corners, corners + 3);
      ++part.Assigned;
      tile.extend(inTile);
    });
}

void RasterSink::sampleTile(Part& part, const Tile& tile) const
{
  const RasterGrid& grid = this->Settings.Grid;
  const RasterWindow& window = tile.Window;
  SimplexMesh mesh;
  mesh.Points = part.XYZ.data();
  mesh.PointCount = std::int64_t(part.XYZ.size() / 3);
  mesh.Ids = tile.Ids.data();
  mesh.Cells = std::int64_t(tile.Ids.size() / 3);
  Lattice lattice = latticeOf(grid);
  lattice.Extent = { int(window.Column), int(window.Column + window.Columns - 1), int(window.Row),
    int(window.Row + window.Rows - 1), 0, 0 };
  const SampledPart sampled = samplePart(this->Settings, part.Columns, mesh, lattice);
  for (const BorderSample& at : sampled.Border)
  {
    const std::int64_t column = window.Column + at.Sample % window.Columns;
    const std::int64_t row = window.Row + at.Sample / window.Columns;
    part.Border.push_back({ row * grid.Columns + column, at.Key });
    for (const std::vector<double>& values : sampled.Bands.Values)
    {
      part.BorderValues.push_back(values[std::size_t(at.Sample)]);
    }
  }
  this->Store->set(window, sampled.IsInside, sampled.Bands.Values);
}

/// Sets the samples on the border of the whole mesh, which no triangle contains.
void RasterSink::answerBorders()
{
  const std::size_t bands = this->Settings.Bands.Bands.size();
  struct Entry
  {
    BorderPixel Sample;
    std::size_t At; ///< index of its values among all
  };
  std::vector<Entry> entries;
  std::vector<double> values;
  for (const std::string& path : filesBeginning(this->Files + borderSuffix))
  {
    const Bytes bytes = readCheckedFile(path);
    LoadArchive archive(bytes);
    std::vector<BorderPixel> pixels;
    std::vector<double> ofPixels;
    archive(pixels, ofPixels);
    for (const BorderPixel& pixel : pixels)
    {
      entries.push_back({ pixel, entries.size() * bands });
    }
    values.insert(values.end(), ofPixels.begin(), ofPixels.end());
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
  TileSource tiles;
  tiles.Read = [this](const RasterWindow& tile, std::vector<std::vector<double>>& values)
  { this->Store->read(tile, values); };
  tiles.ReadFinished = [this](std::int64_t tile) { return this->Store->readFinished(tile); };
  return this->Write(this->Settings, tiles, progress);
}

} // namespace tipp
