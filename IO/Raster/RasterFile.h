// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRasterFile_h
#define tippRasterFile_h

#include "Arrays/Decimal.h"
#include "Crs/GeoKeys.h"
#include "Files/PendingOutput.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The pixel grid of a raster, in the units of the points; rows run along x. A pixel's value is
/// that at its centre. Positions in the grid are those of gridPosition().
struct RasterGrid
{
  double West = 0;                        ///< border of the first column
  double South = 0;                       ///< border of the lowest row
  std::array<double, 2> Pixel = { 1, 1 }; ///< width and height
  std::int64_t Columns = 0;
  std::int64_t Rows = 0;       ///< number of pixels along y
  std::optional<double> North; ///< border of the highest row, if given; otherwise it is computed

  double north() const
  {
    return this->North ? *this->North : gridPosition(this->South, this->Pixel[1], 2 * this->Rows);
  }
  /// The centre of the south-western pixel.
  Point2 firstCentre() const
  {
    return { gridPosition(this->West, this->Pixel[0], 1),
      gridPosition(this->South, this->Pixel[1], 1) };
  }
  std::int64_t pixels() const { return this->Columns * this->Rows; }
};

/// The pixel grid that a user requests.
struct RasterRequest
{
  double Resolution = 0;      ///< side of a pixel, in the units of the points
  std::optional<Box2> Bounds; ///< nullopt: those of the points
  /// Whether pixel borders are at multiples of the resolution; if not, the first pixel starts at
  /// the bounds.
  bool Aligned = true;
  std::optional<RasterGrid> Like; ///< the grid of another raster, which replaces the other members
};

/// Returns the grid that covers the bounds; `pointBounds` are those of the points. Bounds within
/// rounding of a pixel border (see roundingOf()) count as on it. Throws std::runtime_error if they
/// are not finite, or the raster would have too many rows or columns.
VTKTIPPIO_EXPORT RasterGrid makeRasterGrid(const RasterRequest& request, const Box2& pointBounds);

/// How a pixel of an overview is made from the pixels that it stands for.
enum class OverviewRule
{
  Mean,     ///< the mean of their values
  Nearest,  ///< the value of one of them, for masks and classes
  Direction ///< the mean direction of angles in degrees
};

/// What a raster file contains and how it is stored.
struct RasterDescription
{
  RasterGrid Grid;
  std::vector<std::string> Bands;      ///< their names
  std::vector<OverviewRule> Overviews; ///< by band; Mean for those without
  std::string Crs;       ///< WKT, "EPSG:code" or any text that GDAL understands; may be empty
  double NoData = -9999; ///< value of a GeoTIFF's pixels without data
  bool Double = false;   ///< whether a GeoTIFF's values have 64 bits or 32
  std::string Compression = "deflate"; ///< for a GeoTIFF: deflate, lzw, zstd or none
  bool CloudOptimized = false; ///< whether a GeoTIFF has overviews and the layout called COG
  int Threads = 1;             ///< threads that compress
  /// A GeoTIFF that may exceed this size, in bytes, is written as a BigTIFF. Must not exceed the
  /// default, the range of 32-bit offsets.
  std::uint64_t ClassicBytes = std::numeric_limits<std::uint32_t>::max();
};

/// A rectangle of pixels; columns count from the west, rows from the south.
struct RasterWindow
{
  std::int64_t Column = 0; ///< first column
  std::int64_t Row = 0;    ///< first row
  std::int64_t Columns = 0;
  std::int64_t Rows = 0;
};

/// Statistics of the values of a band.
struct BandSums
{
  double Least = std::numeric_limits<double>::infinity();
  double Most = -std::numeric_limits<double>::infinity();
  double Mean = 0;    ///< mean of the values
  double Squares = 0; ///< sum of squared differences from the mean
  double Count = 0;   ///< number of values, without NaN and NoData
  double Hidden = 0;  ///< number of values that equal NoData

  void add(double value);
  void add(const BandSums& other);
  double deviation() const { return std::sqrt(this->Squares / this->Count); }
};

/// An encoded tile: its bytes in the raster file, for each band.
struct EncodedTile
{
  struct Band
  {
    BandSums Sums;
    std::string Bytes;
  };
  std::vector<Band> Bands;
};

/// Throws IOError, which names the band, if a finite value is too large for 32 bits.
VTKTIPPIO_EXPORT void requireSingle(double value, const std::string& band);

/// Encodes a tile (see tileOf()) of a GeoTIFF with the grid, type, compression and NoData of the
/// description. `bands` as for RasterWriter::write(). Thread-safe. Throws IOError as
/// requireSingle().
VTKTIPPIO_EXPORT EncodedTile encodeTile(const RasterDescription& description,
  const RasterWindow& window, const std::vector<const double*>& bands);

/// Writes a raster file tile by tile. It appears at its path only when it is complete.
class VTKTIPPIO_EXPORT RasterWriter
{
public:
  virtual ~RasterWriter();

  /// Writes a tile of the grid (see tileOf()). Each tile must be written once, in any order. For
  /// each band, `bands` points to the tile's values, row by row from the south; NaN means no value.
  /// Several threads may write at the same time; tiles that arrive early are kept in memory. Throws
  /// IOError.
  virtual void write(const RasterWindow& window, const std::vector<const double*>& bands) = 0;

  /// Writes a tile that encodeTile() has made, once, in any order and on any thread. For GeoTIFFs
  /// only. Throws IOError.
  virtual void writeEncoded(std::int64_t tile, EncodedTile encoded);

  /// Completes the file and moves it to its path. Throws IOError.
  virtual void close() = 0;

  /// How many values so far equal NoData, so that readers will treat them as missing.
  virtual double hidden() const { return 0; }
};

/// The side, in pixels, of the square tiles in which rasters are sampled and written; GDAL's
/// default. Tiles are numbered row by row from the north, in each row from the west.
constexpr std::int64_t RasterTileSize = 256;

/// The number of tiles that cover a row or column of pixels.
inline std::int64_t tilesAlong(std::int64_t pixels)
{
  return (pixels + RasterTileSize - 1) / RasterTileSize;
}

/// The number of tiles that cover the grid.
inline std::int64_t tileCount(const RasterGrid& grid)
{
  return tilesAlong(grid.Columns) * tilesAlong(grid.Rows);
}

/// The window of a tile, given its number (from 0).
inline RasterWindow tileOf(const RasterGrid& grid, std::int64_t number)
{
  const std::int64_t across = tilesAlong(grid.Columns);
  const std::int64_t column = number % across * RasterTileSize;
  const std::int64_t top = grid.Rows - number / across * RasterTileSize;
  const std::int64_t row = std::max<std::int64_t>(top - RasterTileSize, 0);
  return { column, row, std::min(RasterTileSize, grid.Columns - column), top - row };
}

/// The number of the tile that a window is.
inline std::int64_t tileNumber(const RasterGrid& grid, const RasterWindow& window)
{
  const std::int64_t across = tilesAlong(grid.Columns);
  const std::int64_t fromNorth = grid.Rows - window.Row - window.Rows;
  return fromNorth / RasterTileSize * across + window.Column / RasterTileSize;
}

/// Calls visit(tile, part) for each tile that a window meets, none if the window is empty: the
/// tile's number, and the part of the window in it.
template <typename Visit>
void forTiles(const RasterGrid& grid, const RasterWindow& window, const Visit& visit)
{
  if (window.Columns <= 0 || window.Rows <= 0)
  {
    return;
  }
  const std::int64_t across = tilesAlong(grid.Columns);
  const std::int64_t right = window.Column + window.Columns;
  const std::int64_t end = window.Row + window.Rows;
  const std::int64_t last = (grid.Rows - 1 - window.Row) / RasterTileSize;
  for (std::int64_t fromNorth = (grid.Rows - end) / RasterTileSize; fromNorth <= last; ++fromNorth)
  {
    const std::int64_t top = grid.Rows - fromNorth * RasterTileSize;
    const std::int64_t row = std::max(top - RasterTileSize, window.Row);
    for (std::int64_t i = window.Column / RasterTileSize; i <= (right - 1) / RasterTileSize; ++i)
    {
      const std::int64_t column = std::max(window.Column, i * RasterTileSize);
      visit(fromNorth * across + i,
        RasterWindow{ column, row, std::min(right, (i + 1) * RasterTileSize) - column,
          std::min(top, end) - row });
    }
  }
}

/// Creates a raster file by its extension: .tif, .npy (float64, rows x columns from the
/// south, with a leading axis for several bands) or .vti (float64, one array per band). `before` as
/// for PendingFile. Throws IOError.
VTKTIPPIO_EXPORT std::unique_ptr<RasterWriter> createRaster(
  const std::string& path, const RasterDescription& description, const PathState& before);

/// Creates a GeoTIFF, whatever the path's extension.
VTKTIPPIO_EXPORT std::unique_ptr<RasterWriter> createGeoTiff(
  const std::string& path, const RasterDescription& description, const PathState& before);

/// Throws IOError, which names `path`, unless a GeoTIFF can be written as described.
VTKTIPPIO_EXPORT void requireGeoTiff(const RasterDescription& description, const std::string& path);

/// Returns the TIFF fields that describe a coordinate reference system. GDAL's libraries take tens
/// of megabytes, so it is loaded in a child process. Without GDAL, see geoKeysWithoutGdal(). Throws
/// IOError if the text is not understood.
VTKTIPPIO_EXPORT const std::vector<TiffField>& geoKeysOf(const std::string& crs);

/// Throws IOError if geoKeysOf() does.
inline void requireCrs(const std::string& text)
{
  geoKeysOf(text);
}

/// @name Functions that use GDAL
/// All throw IOError if GDAL fails. Without GDAL, makeGeoKeys() knows the systems of EPSG, and the
/// others throw IOError.
///@{
/// Describes a coordinate reference system for geoKeysOf(), which remembers the result.
std::vector<TiffField> makeGeoKeys(const std::string& crs);

/// Throws IOError, which names `path`, unless convertGeoTiff() can write such files.
void requireConversion(const RasterDescription& description, const std::string& path);

/// Copies a GeoTIFF to `to`, compressed and laid out as described. Errors name `path`.
void convertGeoTiff(const std::string& from, const std::string& to,
  const RasterDescription& description, const std::string& path);
///@}

} // namespace tipp

#endif
