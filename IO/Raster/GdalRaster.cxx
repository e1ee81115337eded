// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/GeoKeys.h"
#include "Crs/ImportCrs.h"
#include "Crs/TiffDirectory.h"
#include "Files/ChildProcess.h"
#include "Files/IOError.h"
#include "Gdal/GdalLibrary.h"
#include "Raster/RasterFile.h"
#include "Raster/ReadRaster.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

/// Throws IOError with GDAL's last error message.
[[noreturn]] void fail(const std::string& path, const std::string& what)
{
  std::string reason = gdal().CPLGetLastErrorMsg();
  reason = reason.substr(0, reason.find('\n'));
  while (!reason.empty() && reason.back() == '.')
  {
    reason.pop_back();
  }
  throw IOError(path, what + (reason.empty() ? "." : " (" + reason + ")."));
}

/// Returns options, NAME=VALUE each, as GDAL takes them: pointers into `options`, ended by null.
std::vector<char*> gdalOptions(std::vector<std::string>& options)
{
  std::vector<char*> list;
  list.reserve(options.size() + 1);
  for (std::string& option : options)
  {
    list.push_back(option.data());
  }
  list.push_back(nullptr);
  return list;
}

/// The bytes of a GeoTIFF of one pixel that GDAL writes with this reference system.
std::string smallGeoTiff(const std::string& crs)
{
  gdal().CPLErrorReset();
  const GdalReference reference = importUserCrs(crs);
  if (!reference)
  {
    throw IOError("'" + crs.substr(0, 60) +
      "' is no coordinate reference system that GDAL knows; give --crs EPSG:CODE.");
  }
  const char* const path = "/vsimem/tipp-geokeys.tif";
  GdalDataSet data(
    gdal().GDALCreate(gdal().GDALGetDriverByName("GTiff"), path, 1, 1, 1, GDT_Byte, nullptr));
  double transform[6] = { 0, 1, 0, 0, 0, -1 };
  if (!data || gdal().GDALSetGeoTransform(data.get(), transform) != CE_None ||
    gdal().GDALSetSpatialRef(data.get(), reference.get()) != CE_None)
  {
    fail(crs.substr(0, 60), "cannot be described as a GeoTIFF");
  }
  gdal().GDALSetMetadataItem(data.get(), "AREA_OR_POINT", "Area", nullptr);
  data.reset();
  vsi_l_offset size = 0;
  const GByte* const bytes = gdal().VSIGetMemFileBuffer(path, &size, FALSE);
  std::string content(reinterpret_cast<const char*>(bytes), bytes ? std::size_t(size) : 0);
  gdal().VSIUnlink(path);
  return content;
}

std::string upperCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

} // namespace

std::vector<TiffField> makeGeoKeys(const std::string& crs)
{
  const std::string tiff = runInChild([&crs] { return smallGeoTiff(crs); });
  return geoFieldsOf(TiffDirectory(tiff));
}

void requireConversion(const RasterDescription& description, const std::string& path)
{
  runInChild(
    [&]
    {
      std::vector<std::string> options = { "COMPRESS=" + upperCase(description.Compression) };
      const GdalDataSet data(gdal().GDALCreate(gdal().GDALGetDriverByName("GTiff"),
        "/vsimem/tipp-conversion.tif", 1, 1, 1, GDT_Float32, gdalOptions(options).data()));
      if (!data || (description.CloudOptimized && !gdal().GDALGetDriverByName("COG")))
      {
        fail(path, "cannot be written as a GeoTIFF of this kind");
      }
      return std::string();
    });
}

void convertGeoTiff(const std::string& from, const std::string& to,
  const RasterDescription& description, const std::string& path)
{
  constexpr std::int64_t cacheBytes = 16 << 20; // GDAL's default depends on the machine's memory
  gdal().GDALSetCacheMax64(cacheBytes);
  gdal().CPLErrorReset();
  std::vector<std::string> options = { "COMPRESS=" + upperCase(description.Compression),
    "NUM_THREADS=" +
      (description.Threads > 0 ? std::to_string(description.Threads) : std::string("ALL_CPUS")),
    "BIGTIFF=IF_SAFER" };
  if (description.CloudOptimized)
  {
    options.emplace_back(description.Compression != "none" ? "PREDICTOR=YES" : "PREDICTOR=NO");
    options.emplace_back("STATISTICS=YES");
  }
  else
  {
    // Predictor 3 is the one for floating-point numbers.
    options.insert(options.end(), { "TILED=YES", "PREDICTOR=3", "INTERLEAVE=BAND" });
    if (description.Compression == "deflate")
    {
      options.emplace_back("ZLEVEL=1"); // higher levels take twice the time and gain a few per cent
    }
  }
  const std::array<const char*, 2> driver = { "GTiff", nullptr };
  const GdalDataSet plain = openWithDrivers(from, GDAL_OF_RASTER, driver.data());
  GdalDataSet copy(plain
      ? gdal().GDALCreateCopy(
          gdal().GDALGetDriverByName(description.CloudOptimized ? "COG" : "GTiff"), to.c_str(),
          plain.get(), 0, gdalOptions(options).data(), nullptr, nullptr)
      : nullptr);
  if (!copy)
  {
    fail(path, "cannot be written as a GeoTIFF of this kind");
  }
  copy.reset();
  if (gdal().CPLGetLastErrorType() == CE_Failure || gdal().CPLGetLastErrorType() == CE_Fatal)
  {
    fail(path, "cannot be written");
  }
}

RasterInfo readWithGdal(const std::string& path)
{
  const GdalDataSet data = openWithGdal(path, GDAL_OF_RASTER);
  if (!data)
  {
    fail(path, "cannot be read as a raster");
  }
  double transform[6];
  if (gdal().GDALGetGeoTransform(data.get(), transform) != CE_None || transform[2] != 0 ||
    transform[4] != 0 || !(transform[1] > 0) || !(transform[5] < 0))
  {
    refuseGrid(path);
  }
  RasterInfo info;
  RasterGrid& grid = info.Grid;
  grid.Columns = gdal().GDALGetRasterXSize(data.get());
  grid.Rows = gdal().GDALGetRasterYSize(data.get());
  grid.Pixel = { transform[1], -transform[5] };
  grid.West = transform[0];
  grid.South = gridPosition(transform[3], transform[5], 2 * grid.Rows);
  grid.North = transform[3];
  const char* const crs = gdal().GDALGetProjectionRef(data.get());
  info.Crs.Text = crs ? crs : "";
  return info;
}

} // namespace tipp
