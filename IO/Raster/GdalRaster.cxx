// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/GeoKeys.h"
#include "Crs/ImportCrs.h"
#include "Files/ChildProcess.h"
#include "Files/IOError.h"
#include "Gdal/GdalLibrary.h"
#include "Raster/RasterFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
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

template <typename T>
T valueAt(const std::string& bytes, std::size_t offset)
{
  T value;
  if (offset + sizeof value > bytes.size())
  {
    throw IOError("GDAL has made a GeoTIFF that ends too early.");
  }
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
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

/// Extracts the GeoTIFF fields of a little-endian TIFF.
std::vector<TiffField> readGeoKeys(const std::string& tiff)
{
  const std::map<std::uint16_t, std::size_t> tags = { { 34735, sizeof(std::uint16_t) },
    { 34736, sizeof(double) }, { 34737, 1 } };
  if (tiff.compare(0, 4, std::string("II*\0", 4)) != 0)
  {
    throw IOError("GDAL has made a GeoTIFF of another kind than asked for.");
  }
  std::vector<TiffField> fields;
  const std::size_t directory = valueAt<std::uint32_t>(tiff, 4);
  for (std::size_t i = 0; i < valueAt<std::uint16_t>(tiff, directory); ++i)
  {
    const std::size_t at = directory + 2 + 12 * i;
    const auto tag = tags.find(valueAt<std::uint16_t>(tiff, at));
    if (tag == tags.end())
    {
      continue;
    }
    const std::size_t size = tag->second * valueAt<std::uint32_t>(tiff, at + 4);
    const std::size_t begin = size <= 4 ? at + 8 : valueAt<std::uint32_t>(tiff, at + 8);
    fields.push_back(
      { tag->first, static_cast<TiffField::Type>(valueAt<std::uint16_t>(tiff, at + 2)),
        tiff.substr(std::min(begin, tiff.size()), size) });
  }
  return fields;
}

std::string upperCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

} // namespace

const std::vector<TiffField>& geoKeysOf(const std::string& crs)
{
  static std::mutex mutex;
  static std::map<std::string, std::vector<TiffField>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = known.find(crs);
  return found != known.end()
    ? found->second
    : known.emplace(crs, readGeoKeys(runInChild([&crs] { return smallGeoTiff(crs); })))
        .first->second;
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

RasterInfo readRasterInfo(const std::string& path)
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
    throw IOError(path, "is no raster whose rows run from west to east and from north to south.");
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
  info.Crs = crs ? crs : "";
  return info;
}

} // namespace tipp
