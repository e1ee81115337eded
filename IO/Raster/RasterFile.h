// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRasterFile_h
#define tippRasterFile_h

#include "Files/PendingFile.h"
#include "Raster/RasterGrid.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

struct RasterDescription
{
  RasterGrid Grid;
  std::vector<std::string> Bands; ///< their names
  std::string Crs;                ///< WKT, "EPSG:code" or what else GDAL understands; may be empty
  double NoData = -9999;          ///< of a GeoTIFF where there is no value
  bool Double = false;            ///< a GeoTIFF's values have 64 bits, else 32
  std::string Compression = "deflate"; ///< of a GeoTIFF; or lzw, zstd, none
  bool CloudOptimized = false;         ///< a GeoTIFF with overviews, in the layout called COG
  int Threads = 1;                     ///< that compress
};

/// Some pixels of a raster: columns from the west, rows from the south.
struct RasterWindow
{
  std::int64_t Column = 0;
  std::int64_t Row = 0;
  std::int64_t Columns = 0;
  std::int64_t Rows = 0;
};

/// A raster file that is written tile by tile, and is at its path when it is whole.
class VTKTIPPIO_EXPORT RasterWriter
{
public:
  virtual ~RasterWriter();

  /// Each tile of the grid once (see tileOf()): for each band its values row by row, the most
  /// southern first, NaN where there is none. Several threads may write at once; tiles that are
  /// early wait in memory. Throws IOError.
  virtual void write(const RasterWindow& window, const std::vector<const double*>& bands) = 0;

  /// Puts the file in its place. Throws IOError.
  virtual void close() = 0;
};

/// Rasters are sampled and written by squares of so many pixels, those of GDAL's tiles: row by row
/// from the north on, each row from the west on.
constexpr std::int64_t RasterTileSize = 256;

inline std::int64_t tileCount(const RasterGrid& grid)
{
  const auto along = [](std::int64_t pixels)
  { return (pixels + RasterTileSize - 1) / RasterTileSize; };
  return along(grid.Columns) * along(grid.Rows);
}

/// The tile of a number from 0 on.
inline RasterWindow tileOf(const RasterGrid& grid, std::int64_t number)
{
  const std::int64_t across = (grid.Columns + RasterTileSize - 1) / RasterTileSize;
  const std::int64_t column = number % across * RasterTileSize;
  const std::int64_t top = grid.Rows - number / across * RasterTileSize;
  const std::int64_t row = std::max<std::int64_t>(top - RasterTileSize, 0);
  return { column, row, std::min(RasterTileSize, grid.Columns - column), top - row };
}

/// The number of the tile of a window.
inline std::int64_t tileNumber(const RasterGrid& grid, const RasterWindow& window)
{
  const std::int64_t across = (grid.Columns + RasterTileSize - 1) / RasterTileSize;
  const std::int64_t fromNorth = grid.Rows - window.Row - window.Rows;
  return fromNorth / RasterTileSize * across + window.Column / RasterTileSize;
}

/// By the file's extension: .tif (GDAL), .npy (float64, rows x columns, the most southern row
/// first, for several bands these before) or .vti (float64, an array for each band). Throws
/// IOError.
VTKTIPPIO_EXPORT std::unique_ptr<RasterWriter> createRaster(
  const std::string& path, const RasterDescription& description, const PathState& before);

/// .tif, .tiff, .npy and .vti.
VTKTIPPIO_EXPORT bool isRasterFile(const std::string& path);

/// Whether the path is that of a GeoTIFF.
VTKTIPPIO_EXPORT bool isGeoTiff(const std::string& path);

std::unique_ptr<RasterWriter> createGeoTiff(
  const std::string& path, const RasterDescription& description, const PathState& before);

struct RasterInfo
{
  RasterGrid Grid;
  std::string Crs; ///< WKT, or empty
};

/// Of a north-up raster that GDAL reads. Throws IOError.
VTKTIPPIO_EXPORT RasterInfo readRasterInfo(const std::string& path);

/// Throws IOError if GDAL does not understand the text, or is not there.
VTKTIPPIO_EXPORT void requireCrs(const std::string& text);

} // namespace tipp

#endif
