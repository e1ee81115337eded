// SPDX-License-Identifier: BSD-3-Clause
// Replaces what needs GDAL, in a build without it.
#include "Crs/WriteGeoKeys.h"
#include "Files/IOError.h"
#include "Raster/RasterValues.h"
#include "Raster/ReadRaster.h"

namespace tipp
{

std::vector<TiffField> makeGeoKeys(const std::string& crs)
{
  return geoKeysWithoutGdal(crs);
}

RasterInfo readWithGdal(const std::string& path)
{
  throw IOError(path,
    "is no GeoTIFF that says where its pixels are, and this tipp was built without GDAL, which "
    "reads other rasters; convert it, as with 'gdal_translate FILE out.tif'.");
}

std::unique_ptr<RasterValues> openRasterValues(const std::string& path)
{
  throw IOError(path,
    "is a raster, whose values tipp reads with GDAL, and this tipp was built without it; convert "
    "it to points, as with 'gdal_translate FILE out.xyz'.");
}

void requireConversion(const RasterDescription& description, const std::string& path)
{
  throw IOError(path,
    "cannot be written with the compression " + description.Compression +
      ", because this tipp was built without GDAL; give --compress " +
      (description.Compression == "deflate" ? "none." : "deflate or none."));
}

void convertGeoTiff(const std::string&, const std::string&, const RasterDescription& description,
  const std::string& path)
{
  requireConversion(description, path);
}

} // namespace tipp
