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

/// A raster file that is written window by window, and is at its path when it is whole.
class VTKTIPPIO_EXPORT RasterWriter
{
public:
  virtual ~RasterWriter();

  /// Each window once: for each band its values row by row, the most southern first. NaN where
  /// there is none. Throws IOError.
  virtual void write(const RasterWindow& window, const std::vector<const double*>& bands) = 0;

  /// Puts the file in its place. Throws IOError.
  virtual void close() = 0;
};

/// Rasters are sampled and written by squares of so many pixels, those of GDAL's tiles: row by row
/// from the north on, each row from the west on.
constexpr std::int64_t RasterTileSize = 256;

/// Calls visit(window) for each tile of a grid in that order.
template <typename Visit>
void forEachTile(const RasterGrid& grid, const Visit& visit)
{
  for (std::int64_t top = grid.Rows; top > 0; top -= RasterTileSize)
  {
    const std::int64_t row = std::max<std::int64_t>(top - RasterTileSize, 0);
    for (std::int64_t column = 0; column < grid.Columns; column += RasterTileSize)
    {
      visit(
        RasterWindow{ column, row, std::min(RasterTileSize, grid.Columns - column), top - row });
    }
  }
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
