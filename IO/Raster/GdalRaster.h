// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGdalRaster_h
#define tippGdalRaster_h

#include "Raster/RasterFile.h"
#include "Raster/TiledTiff.h"
#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Runs work in a process of its own, so that the libraries it opens take no memory of this one,
/// and returns what it returns. Throws IOError with the same sentence where the work does.
VTKTIPPIO_EXPORT std::string runInChild(const std::function<std::string()>& work);

/// What GDAL does for rasters. All throw IOError if it fails or is not there.

/// The fields of a TIFF that tell a coordinate reference system. GDAL, whose libraries take tens of
/// megabytes, is opened in a process of its own.
const std::vector<TiffField>& geoKeysOf(const std::string& crs);

/// Throws IOError, in which `path` is named, unless convertGeoTiff() can write files as described.
void requireConversion(const RasterDescription& description, const std::string& path);

/// Copies a GeoTIFF to `to`, compressed and laid out as described. Errors name `path`.
void convertGeoTiff(const std::string& from, const std::string& to,
  const RasterDescription& description, const std::string& path);

} // namespace tipp

#endif
