// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/GeoKeys.h"
#include "Crs/ImportCrs.h"
#include "Crs/TiffDirectory.h"
#include "Files/ChildProcess.h"
#include "Files/IOError.h"
#include "Gdal/GdalLibrary.h"
#include "Raster/RasterFile.h"
#include "Raster/RasterValues.h"
#include "Raster/ReadRaster.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
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

namespace
{

GdalDataSet openWithGrid(const std::string& path)
{
  GdalDataSet data = openWithGdal(path, GDAL_OF_RASTER);
  if (!data)
  {
    fail(path, "cannot be read as a raster");
  }
  return data;
}

RasterGrid gridOf(GDALDatasetH data, const std::string& path)
{
  double transform[6];
  if (gdal().GDALGetGeoTransform(data, transform) != CE_None || transform[2] != 0 ||
    transform[4] != 0 || !(transform[1] > 0) || !(transform[5] < 0) ||
    !std::all_of(
      std::begin(transform), std::end(transform), [](double x) { return std::isfinite(x); }))
  {
    refuseGrid(path);
  }
  RasterGrid grid;
  grid.Columns = gdal().GDALGetRasterXSize(data);
  grid.Rows = gdal().GDALGetRasterYSize(data);
  grid.Pixel = { transform[1], -transform[5] };
  grid.West = transform[0];
  grid.South = gridPosition(transform[3], transform[5], 2 * grid.Rows);
  grid.North = transform[3];
  return grid;
}

class GdalValues : public RasterValues
{
public:
  GdalValues(const std::string& path, GdalDataSet data)
    : RasterValues(gridOf(data.get(), path))
    , Path(path)
    , Data(std::move(data))
  {
    const int bands = gdal().GDALGetRasterCount(this->Data.get());
    if (bands != 1)
    {
      throw IOError(path,
        "has " + std::to_string(bands) +
          " bands; give a raster of one, as 'gdal_translate -b 1 FILE one.tif' makes it.");
    }
    this->Band = gdal().GDALGetRasterBand(this->Data.get(), 1);
    int isSet = 0;
    const double noData = gdal().GDALGetRasterNoDataValue(this->Band, &isSet);
    this->NoData = isSet != 0 ? std::make_optional(noData) : std::nullopt;
    this->IsSingle = gdal().GDALGetRasterDataType(this->Band) == GDT_Float32;
    const double scale = gdal().GDALGetRasterScale(this->Band, &isSet);
    this->Scale = isSet != 0 ? scale : 1;
    const double offset = gdal().GDALGetRasterOffset(this->Band, &isSet);
    this->Offset = isSet != 0 ? offset : 0;
  }

  void read(const RasterWindow& window, double* values) override
  {
    const int columns = int(window.Columns);
    const int rows = int(window.Rows);
    gdal().CPLErrorReset();
    // GDAL counts rows from the north.
    if (gdal().GDALRasterIO(this->Band, GF_Read, int(window.Column),
          int(this->grid().Rows - window.Row - window.Rows), columns, rows, values, columns, rows,
          GDT_Float64, 0, 0) != CE_None)
    {
      fail(this->Path, "cannot be read");
    }
    for (std::int64_t low = 0, high = window.Rows - 1; low < high; ++low, --high)
    {
      std::swap_ranges(values + low * window.Columns, values + (low + 1) * window.Columns,
        values + high * window.Columns);
    }
    std::transform(values, values + window.Columns * window.Rows, values,
      [this](double value) { return this->valueOf(value); });
  }

private:
  double valueOf(double stored) const
  {
    // A file of 32 bits may give a mark with more digits than its pixels have.
    const bool isMissing = this->NoData &&
      (stored == *this->NoData || (this->IsSingle && float(stored) == float(*this->NoData)));
    return isMissing ? std::numeric_limits<double>::quiet_NaN()
                     : stored * this->Scale + this->Offset;
  }

  std::string Path;
  GdalDataSet Data;
  GDALRasterBandH Band = nullptr; ///< owned by Data
  std::optional<double> NoData;
  bool IsSingle = false; ///< whether pixels are float32
  double Scale = 1;
  double Offset = 0;
};

} // namespace

RasterInfo readWithGdal(const std::string& path)
{
  const GdalDataSet data = openWithGrid(path);
  RasterInfo info;
  info.Grid = gridOf(data.get(), path);
  const char* const crs = gdal().GDALGetProjectionRef(data.get());
  info.Crs.Text = crs ? crs : "";
  return info;
}

std::unique_ptr<RasterValues> openRasterValues(const std::string& path)
{
  return std::make_unique<GdalValues>(path, openWithGrid(path));
}

} // namespace tipp
