// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRasterTiles_h
#define tippRasterTiles_h

#include "Dem/TerrainSampler.h"
#include "Dem/TileStore.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace tipp
{

/// A source of the tiles of a raster. Several threads may call its functions at once.
struct TileSource
{
  /// Returns the values of a tile, one vector per band.
  std::function<void(const RasterWindow&, BandValues&)> Read;
  /// Returns the tile with this number if it is already encoded. Null: no tile is.
  std::function<std::optional<FinishedTile>(std::int64_t)> ReadFinished;
};

/// A source of tiles of a whole grid in memory. Both arguments must outlive the result.
VTKTIPPFILTERS_EXPORT TileSource readFrom(const RasterGrid& grid, const BandValues& samples);

/// Copies all tiles into the grid. Returns false if `progress` stopped it.
bool readTiles(const TerrainSettings& settings, const TileSource& tiles,
  const std::function<bool(double)>& progress, BandValues& samples);

/// Calls fillVoids(), and returns how many pixels of the first band had a value before.
std::int64_t fillTile(const DemBands& bands, BandValues& values);

/// Returns a pointer to each vector's values, as RasterWriter::write() takes them.
std::vector<const double*> pointersTo(const BandValues& values);

/// Writes all tiles; voids of `bands` are filled, see fillVoids(). Returns the number of pixels
/// whose first band has a value from a triangle, or -1 if `progress` stopped it. `threads` = 0 is
/// defaultThreads(). Throws IOError.
VTKTIPPFILTERS_EXPORT std::int64_t writeTiles(RasterWriter& writer, const RasterGrid& grid,
  const TileSource& tiles, const std::function<bool(double)>& progress, int threads,
  const DemBands& bands = {});

} // namespace tipp

#endif
