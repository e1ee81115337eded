// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTiledTiff_h
#define tippTiledTiff_h

#include "Files/OutputFile.h"
#include "Raster/RasterFile.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// A field of a TIFF file's directory.
struct TiffField
{
  enum class Type : std::uint16_t
  {
    Text = 2,
    Short = 3,
    Long = 4,
    Double = 12,
    Long8 = 16
  };
  std::uint16_t Tag = 0; ///< the field's tag number
  Type Is = Type::Short;
  std::string Bytes; ///< the values, little-endian
};

template <typename T>
TiffField tiffField(std::uint16_t tag, TiffField::Type type, const std::vector<T>& values)
{
  return { tag, type,
    std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)) };
}

/// Writes a TIFF file of floating-point bands, each in its own tiles, from the north-west on. It
/// becomes a BigTIFF if it may exceed `classicBytes`, which must not exceed the range of 32-bit
/// offsets.
class TiledTiff
{
public:
  /// `file` must outlive this object.
  TiledTiff(const OutputFile& file, const RasterGrid& grid, std::size_t bands, bool isDouble,
    bool isDeflated, std::uint64_t classicBytes);

  /// Appends the next tile of a band: RasterTileSize rows of RasterTileSize values of the file's
  /// type, northernmost row first; for a deflated file, the result of deflateTile(). Throws
  /// IOError.
  void append(std::size_t band, const std::string& tile);

  /// Completes the file with a directory of these fields and those that describe the pixels. Throws
  /// IOError.
  void finish(std::vector<TiffField> fields);

private:
  std::vector<TiffField> pixelFields() const;

  const OutputFile& File;
  const RasterGrid Grid;
  const bool IsDouble;
  const bool IsDeflated;
  const std::uint64_t ClassicBytes;
  std::uint64_t End; ///< end of the written data
  struct Band
  {
    std::vector<std::uint64_t> Offsets; ///< offsets of its tiles
    std::vector<std::uint64_t> Sizes;
  };
  std::vector<Band> Bands;
};

/// Whether this build can deflate tiles without GDAL.
bool canDeflateTiles();

/// Compresses a tile of values of `valueSize` bytes for a deflated file. Thread-safe.
std::string deflateTile(const std::string& pixels, std::size_t valueSize);

} // namespace tipp

#endif
