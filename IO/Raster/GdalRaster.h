// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGdalRaster_h
#define tippGdalRaster_h

#include "Raster/RasterFile.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Runs `work` in a child process, so that the libraries it loads take no memory in this one, and
/// returns its result. If `work` throws an IOError, throws one with the same message.
VTKTIPPIO_EXPORT std::string runInChild(const std::function<std::string()>& work);

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

/// Functions that use GDAL. All throw IOError if GDAL fails or is not installed.

/// The TIFF fields that describe a coordinate reference system. GDAL's libraries take tens of
/// megabytes, so it is loaded in a child process.
const std::vector<TiffField>& geoKeysOf(const std::string& crs);

/// Throws IOError, which names `path`, unless convertGeoTiff() can write such files.
void requireConversion(const RasterDescription& description, const std::string& path);

/// Copies a GeoTIFF to `to`, compressed and laid out as described. Errors name `path`.
void convertGeoTiff(const std::string& from, const std::string& to,
  const RasterDescription& description, const std::string& path);

} // namespace tipp

#endif
