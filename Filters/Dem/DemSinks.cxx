// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/DemSinks.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "Files/IOError.h"
#include "OutOfCore/ScratchFiles.h"
#include "Resample/Claims.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <tuple>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

/// The files whose paths begin with this one. Throws IOError.
std::vector<std::string> filesBeginning(const std::string& path)
{
  const fs::path begin(path);
  const std::string prefix = begin.filename().string();
  std::vector<std::string> files;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(begin.parent_path(), failure))
  {
    if (entry.path().filename().string().compare(0, prefix.size(), prefix) == 0)
    {
      files.push_back(entry.path().string());
    }
  }
  if (failure)
  {
    throw IOError(begin.parent_path().string(), "cannot be read (" + failure.message() + ").");
  }
  return files;
}

/// Calls visit(corners) for each triangle; `corners` are the indices of its three points.
template <typename Visit>
void forEachTriangle(const std::vector<TriangleRange>& triangles, const Visit& visit)
{
  for (const TriangleRange& run : triangles)
  {
    for (std::size_t t = 0; t < run.Triangles; ++t)
    {
      visit(run.Begin + 3 * t);
    }
  }
}

/// The suffix of files with surface values, appended to the run's own path.
constexpr const char* surfaceSuffix = ".surface.";

struct Answer
{
  SurfaceTriangle Triangle;
  std::vector<double> Values; ///< one per column
};

/// Surface values, by index of the position.
using Answers = std::map<std::size_t, Answer>;

/// Keeps the answer, or the known one if its triangle comes first.
void choose(std::size_t position, Answer answer, Answers& answers)
{
  const auto [known, isNew] = answers.try_emplace(position, std::move(answer));
  if (!isNew && answer.Triangle.isBefore(known->second.Triangle))
  {
    known->second = std::move(answer);
  }
}

std::vector<Point2> positionsOf(const TableConstraints& constraints)
{
  std::vector<Point2> positions;
  for (const ConstraintTable* const table : { &constraints.Lines, &constraints.Boundary })
  {
    for (std::size_t i = 0; i < table->XY.size(); i += 2)
    {
      positions.push_back({ table->XY[i], table->XY[i + 1] });
    }
  }
  return positions;
}

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

bool needsSurface(const TableConstraints& constraints, const std::vector<std::string>& bands)
{
  const auto lacksHeights = [](const ConstraintTable& table)
  {
    return 2 * table.Height.size() < table.XY.size() ||
      std::any_of(
        table.Height.begin(), table.Height.end(), [](double height) { return std::isnan(height); });
  };
  const std::vector<std::string> columns = columnsForBands(bands);
  return lacksHeights(constraints.Lines) || lacksHeights(constraints.Boundary) ||
    !std::all_of(columns.begin(), columns.end(), isHeightColumn);
}

SurfaceSink::SurfaceSink(const TableConstraints& constraints)
  : Identity("surface below " + identityOf(constraints))
  , Positions(positionsOf(constraints))
  , Wanted(this->Positions)
{
}

std::uint64_t SurfaceSink::fileBytes(const Box2&, const std::vector<std::string>& columns) const
{
  return (7 + columns.size()) * sizeof(double) * this->Positions.size();
}

void SurfaceSink::begin(
  const Box2&, const std::vector<std::string>& columns, const std::string& files)
{
  this->Columns = columns.size();
  this->Elevation = findElevation(columns);
  this->Files = files;
}

void SurfaceSink::take(const std::string& name, const double* rows, const PointRowLayout& layout,
  std::size_t points, const std::vector<TriangleRange>& triangles)
{
  if (!this->Wanted.meets(surveyPoints(PointsView(rows, points, layout.Words), 1).Bounds))
  {
    return;
  }
  Answers answers;
  forEachTriangle(triangles,
    [&](const std::int32_t* corners)
    {
      const auto rowOf = [&](std::size_t corner)
      { return rows + std::size_t(corners[corner]) * layout.Words; };
      const std::array<Point2, 3> p{ Point2{ rowOf(0)[0], rowOf(0)[1] },
        Point2{ rowOf(1)[0], rowOf(1)[1] }, Point2{ rowOf(2)[0], rowOf(2)[1] } };
      this->Wanted.visitInside(p,
        [&](std::size_t i, Point2 position)
        {
          Answer answer{ SurfaceTriangle(p), {} };
          for (std::size_t c = 0; c < this->Columns; ++c)
          {
            answer.Values.push_back(answer.Triangle.valueAt(
              position, [&](std::size_t corner) { return rowOf(corner)[2 + c]; }));
          }
          choose(i, std::move(answer), answers);
        });
    });
  if (!answers.empty())
  {
    writeCheckedFile(this->Files + surfaceSuffix + name,
      [&answers](SaveArchive& archive)
      {
        archive(std::uint64_t(answers.size()));
        for (const auto& [position, answer] : answers)
        {
          archive(std::uint64_t(position), answer.Triangle.Corners, answer.Values);
        }
      });
  }
}

bool SurfaceSink::end(const std::function<bool(double)>& progress)
{
  Answers answers;
  for (const std::string& path : filesBeginning(this->Files + surfaceSuffix))
  {
    const Bytes bytes = readCheckedFile(path);
    LoadArchive archive(bytes);
    for (auto left = archive.get<std::uint64_t>(); left > 0; --left)
    {
      const auto position = archive.get<std::uint64_t>();
      const SurfaceTriangle triangle(archive.get<std::array<Point2, 3>>());
      choose(position, { triangle, archive.get<std::vector<double>>() }, answers);
    }
  }
  this->Values.assign(this->Columns, std::vector<double>(this->Positions.size(), std::nan("")));
  for (const auto& [position, answer] : answers)
  {
    for (std::size_t c = 0; c < this->Columns; ++c)
    {
      this->Values[c].at(position) = answer.Values.at(c);
    }
  }
  return progress(1);
}

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

RasterSink::RasterSink(MakeSettings makeSettings, WriteRaster writeRaster,
  const std::optional<RasterDescription>& encoding)
  : Make(std::move(makeSettings))
  , Write(std::move(writeRaster))
  , Encoding(encoding)
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
    finish = [this](const RasterWindow& window, BandValues& values)
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
  const auto copyWord =
    [&](std::size_t word, std::vector<double>& to, std::size_t first, std::size_t stride)
  {
    const bool isHeight = bands.Elevation && word == 2 + *bands.Elevation;
    for (std::size_t i = 0; i < points; ++i)
    {
      const double value = rows[i * layout.Words + word];
      to[first + i * stride] = isHeight ? heightOf(value) : value;
    }
  };
  part.XYZ.resize(3 * points);
  copyWord(0, part.XYZ, 0, 3);
  copyWord(1, part.XYZ, 1, 3);
  if (bands.Elevation)
  {
    copyWord(2 + *bands.Elevation, part.XYZ, 2, 3);
  }
  part.Values.resize(layout.Words - 3);
  part.Columns.resize(part.Values.size());
  for (const DemBand& band : bands.Bands)
  {
    if (band.Type == DemBand::Kind::Column)
    {
      std::vector<double>& column = part.Values[band.Column];
      column.resize(points);
      copyWord(2 + band.Column, column, 0, 1);
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
  all.Window = this->windowOf(surveyPoints(PointsView(rows, points, layout.Words), 1).Bounds);
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
  forEachTriangle(triangles,
    [&](const std::int32_t* corners)
    {
      const double* const a = &part.XYZ[3 * std::size_t(corners[0])];
      const double* const b = &part.XYZ[3 * std::size_t(corners[1])];
      const double* const c = &part.XYZ[3 * std::size_t(corners[2])];
      const RasterWindow window =
        this->windowOf({ { std::min({ a[0], b[0], c[0] }), std::min({ a[1], b[1], c[1] }) },
          { std::max({ a[0], b[0], c[0] }), std::max({ a[1], b[1], c[1] }) } });
      forTiles(this->Settings.Grid, window,
        [&](std::int64_t number, const RasterWindow& inTile)
        {
          Tile& tile = part.tileAt(number);
          tile.Ids.insert(tile.Ids.end(), corners, corners + 3);
          tile.extend(inTile);
          ++part.Assigned;
        });
      if (part.Assigned > mostAssigned)
      {
        sampleAll();
      }
    });
  sampleAll();
}

/// The window of samples that may lie in a box; empty if there are none.
RasterWindow RasterSink::windowOf(const Box2& box) const
{
  const RasterGrid& grid = this->Settings.Grid;
  const auto [column, lastColumn] =
    samplesBetween(box.Min.x, box.Max.x, grid.West, grid.Pixel[0], this->Margins[0], grid.Columns);
  const auto [row, lastRow] =
    samplesBetween(box.Min.y, box.Max.y, grid.South, grid.Pixel[1], this->Margins[1], grid.Rows);
  return column > lastColumn || row > lastRow
    ? RasterWindow()
    : RasterWindow{ column, row, lastColumn - column + 1, lastRow - row + 1 };
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
  if (this->Settings.IsSingle)
  {
    this->requireSingles(sampled.Values);
  }
  for (const BorderSample& at : sampled.Border)
  {
    const std::int64_t column = window.Column + at.Sample % window.Columns;
    const std::int64_t row = window.Row + at.Sample / window.Columns;
    part.Border.push_back({ row * grid.Columns + column, at.Key });
    for (const std::vector<double>& values : sampled.Values)
    {
      part.BorderValues.push_back(values[std::size_t(at.Sample)]);
    }
  }
  this->Store->set(window, sampled.IsInside, sampled.Values);
}

/// Throws IOError if a value is too large for 32 bits.
void RasterSink::requireSingles(const BandValues& values) const
{
  for (std::size_t band = 0; band < values.size(); ++band)
  {
    for (const double value : values[band])
    {
      requireSingle(value, this->Settings.Bands.Bands[band].Name);
    }
  }
}

/// Sets the samples on the border of the whole mesh, which no triangle contains.
void RasterSink::answerBorders()
{
  const std::size_t bands = this->Settings.Bands.Bands.size();
  struct BorderSample : BorderPixel
  {
    std::size_t Values; ///< index of its values among all
  };
  std::vector<BorderSample> samples;
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
      samples.push_back({ pixel, samples.size() * bands });
    }
    values.insert(values.end(), ofPixels.begin(), ofPixels.end());
  }
  std::sort(samples.begin(), samples.end(),
    [](const BorderSample& a, const BorderSample& b)
    { return std::tie(a.Pixel, a.Key) < std::tie(b.Pixel, b.Key); });
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (i == 0 || samples[i].Pixel != samples[i - 1].Pixel)
    {
      this->Store->setIfMissing(samples[i].Pixel, values.data() + samples[i].Values);
    }
  }
}

bool RasterSink::end(const std::function<bool(double)>& progress)
{
  this->answerBorders();
  TileSource tiles;
  tiles.Read = [this](const RasterWindow& tile, BandValues& values)
  { this->Store->read(tile, values); };
  tiles.ReadFinished = [this](std::int64_t tile) { return this->Store->readFinished(tile); };
  return this->Write(this->Settings, tiles, progress);
}

} // namespace tipp
