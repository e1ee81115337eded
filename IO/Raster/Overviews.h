// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOverviews_h
#define tippOverviews_h

#include "Raster/RasterFile.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// The numbers of columns and rows of an overview. Each pixel stands for a square of 2^level
/// pixels of the raster, cut off at its eastern and southern border.
struct OverviewSize
{
  std::int64_t Columns;
  std::int64_t Rows;

  std::int64_t tiles() const { return tilesAlong(this->Columns) * tilesAlong(this->Rows); }
};

/// The sizes of the raster (level 0) and of its overviews, each half of the one before, until one
/// has at most 512 rows and columns, a tile of a cloud optimized GeoTIFF.
VTKTIPPIO_EXPORT std::vector<OverviewSize> overviewSizes(const RasterGrid& grid);

/// A tile of a band: RasterTileSize rows of as many values from the north; NaN for no value.
using TilePixels = std::vector<double>;

/// The tiles of a band and its overviews, numbered as those of RasterGrid.
struct OverviewTiles
{
  /// Returns a tile of the raster.
  std::function<TilePixels(std::int64_t tile)> Read;
  /// Takes a tile of an overview; levels count from 1.
  std::function<void(std::size_t level, std::int64_t tile, const TilePixels& pixels)> Write;
};

/// Computes all overviews of a band. Each tile is read once, and only a few are in memory.
VTKTIPPIO_EXPORT void makeOverviews(
  const std::vector<OverviewSize>& sizes, OverviewRule rule, const OverviewTiles& tiles);

} // namespace tipp

#endif
