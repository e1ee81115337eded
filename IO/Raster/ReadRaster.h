// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadRaster_h
#define tippReadRaster_h

#include "Crs/ReferenceSystem.h"
#include "Raster/RasterFile.h"
#include "vtkTIPPIOModule.h"

#include <optional>
#include <string>

namespace tipp
{

/// The grid and the reference system of an existing raster.
struct RasterInfo
{
  RasterGrid Grid;
  ReferenceSystem Crs;
};

/// Reads the grid and the reference system of a north-up raster: of a GeoTIFF, or of another format
/// with GDAL. Throws IOError.
VTKTIPPIO_EXPORT RasterInfo readRasterInfo(const std::string& path);

/// Reads those of a GeoTIFF, without GDAL; nullopt if the file itself does not say where its pixels
/// are. Throws IOError if it is no TIFF, is damaged, or is not north-up.
VTKTIPPIO_EXPORT std::optional<RasterInfo> readGeoTiffInfo(const std::string& path);

/// Reads those of any raster. Throws IOError, also if GDAL fails or is not installed.
RasterInfo readWithGdal(const std::string& path);

/// Throws IOError: the raster at `path` is not north-up.
[[noreturn]] void refuseGrid(const std::string& path);

} // namespace tipp

#endif
