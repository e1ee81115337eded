// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/RasterTiles.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

/// Calls copy(begin in the tile, begin in the grid, size) for each row of a tile of the grid.
template <typename Copy>
void forRows(const RasterGrid& grid, const RasterWindow& tile, const Copy& copy)
{
  for (std::int64_t row = 0; row < tile.Rows; ++row)
  {
    copy(row * tile.Columns, (tile.Row + row) * grid.Columns + tile.Column, tile.Columns);
  }
}

} // namespace

bool readTiles(const TerrainSettings& settings, const TileSource& tiles,
  const std::function<bool(double)>& progress, BandValues& samples)
{
  const RasterGrid& grid = settings.Grid;
  samples.resize(settings.Bands.Bands.size());
  for (std::vector<double>& band : samples)
  {
    band.resize(std::size_t(grid.pixels()));
  }
  return forChunks(tileCount(grid), 1, settings.Threads, progress,
    [&](std::int64_t number, std::int64_t, int)
    {
      const RasterWindow window = tileOf(grid, number);
      BandValues values;
      tiles.Read(window, values);
      for (std::size_t band = 0; band < values.size(); ++band)
      {
        forRows(grid, window,
          [&](std::int64_t inTile, std::int64_t inGrid, std::int64_t size)
          { std::copy_n(values[band].data() + inTile, size, samples[band].data() + inGrid); });
      }
    });
}

TileSource readFrom(const RasterGrid& grid, const BandValues& samples)
{
  TileSource source;
  source.Read = [&grid, &samples](const RasterWindow& window, BandValues& values)
  {
    values.resize(samples.size());
    for (std::size_t band = 0; band < values.size(); ++band)
    {
      values[band].resize(std::size_t(window.Columns * window.Rows));
      forRows(grid, window,
        [&](std::int64_t inTile, std::int64_t inGrid, std::int64_t size)
        { std::copy_n(samples[band].data() + inGrid, size, values[band].data() + inTile); });
    }
  };
  return source;
}

std::int64_t fillTile(const DemBands& bands, BandValues& values)
{
  const auto filled = std::count_if(
    values.front().begin(), values.front().end(), [](double value) { return !std::isnan(value); });
  fillVoids(bands, values);
  return filled;
}

std::vector<const double*> pointersTo(const BandValues& values)
{
  std::vector<const double*> pointers;
  pointers.reserve(values.size());
  for (const std::vector<double>& band : values)
  {
    pointers.push_back(band.data());
  }
  return pointers;
}

std::int64_t writeTiles(RasterWriter& writer, const RasterGrid& grid, const TileSource& tiles,
  const std::function<bool(double)>& progress, int threads, const DemBands& bands)
{
  std::atomic<std::int64_t> filled{ 0 };
  const bool isDone = forChunks(tileCount(grid), 1, threadCount(threads), progress,
    [&](std::int64_t number, std::int64_t, int)
    {
      std::optional<FinishedTile> finished;
      if (tiles.ReadFinished && (finished = tiles.ReadFinished(number)))
      {
        filled += finished->Filled;
        writer.writeEncoded(number, std::move(finished->Encoded));
        return;
      }
      const RasterWindow window = tileOf(grid, number);
      BandValues values;
      tiles.Read(window, values);
      filled += fillTile(bands, values);
      writer.write(window, pointersTo(values));
    });
  return isDone ? filled.load() : -1;
}

} // namespace tipp
