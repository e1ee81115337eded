// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/GdalLibrary.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Raster/RasterFile.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include <dlfcn.h>

namespace tipp
{
namespace
{

GdalLibrary openGdal()
{
  void* const library = dlopen(TIPP_GDAL_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  if (!library)
  {
    throw IOError("GeoTIFF and other files of GIS need the library GDAL (" TIPP_GDAL_LIBRARY
                  "), which cannot be opened; install it, or use another format.");
  }
  GdalLibrary functions;
  const auto find = [&](auto& function, const char* name)
  {
    void* const address = dlsym(library, name);
    if (!address)
    {
      throw IOError(std::string("The library " TIPP_GDAL_LIBRARY " has no function ") + name +
        "; install the version of GDAL that this program was built with.");
    }
    function = reinterpret_cast<std::decay_t<decltype(function)>>(address);
  };
#define TIPP_FIND_FUNCTION(name) find(functions.name, #name);
  TIPP_GDAL_FUNCTIONS(TIPP_FIND_FUNCTION)
#undef TIPP_FIND_FUNCTION
  // GDAL must not print: its messages are included in our exceptions.
  functions.CPLSetErrorHandler(functions.CPLQuietErrorHandler);
  functions.GDALAllRegister();
  return functions;
}

} // namespace

const GdalLibrary& gdal()
{
  static const GdalLibrary library = openGdal();
  return library;
}

void forFeatures(
  const std::string& path, const std::function<void(OGRFeatureH, OGRGeometryH)>& visit)
{
  gdal().CPLErrorReset();
  const GdalDataSet file(
    gdal().GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  if (!file)
  {
    const std::string reason = gdal().CPLGetLastErrorMsg();
    throw IOError(path,
      "cannot be read as lines or polygons" +
        (reason.empty() ? std::string(".") : " (" + reason + ")."));
  }
  const int layers = gdal().GDALDatasetGetLayerCount(file.get());
  for (int i = 0; i < layers; ++i)
  {
    const OGRLayerH layer = gdal().GDALDatasetGetLayer(file.get(), i);
    gdal().OGR_L_ResetReading(layer);
    while (const OGRFeatureH feature = gdal().OGR_L_GetNextFeature(layer))
    {
      const GdalOwner<OGRFeatureH, &GdalLibrary::OGR_F_Destroy> held(feature);
      const OGRGeometryH geometry = gdal().OGR_F_GetGeometryRef(feature);
      const bool isCurved = geometry && gdal().OGR_G_HasCurveGeometry(geometry, 1);
      const GdalOwner<OGRGeometryH, &GdalLibrary::OGR_G_DestroyGeometry> straight(
        isCurved ? gdal().OGR_G_GetLinearGeometry(geometry, 0, nullptr) : nullptr);
      visit(feature, isCurved ? straight.get() : geometry);
    }
  }
  if (gdal().CPLGetLastErrorType() >= CE_Failure)
  {
    throw IOError(path, "is damaged (" + std::string(gdal().CPLGetLastErrorMsg()) + ").");
  }
}

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
  const GdalOwner<OGRSpatialReferenceH, &GdalLibrary::OSRDestroySpatialReference> reference(
    gdal().OSRNewSpatialReference(nullptr));
  gdal().CPLErrorReset();
  if (gdal().OSRSetFromUserInput(reference.get(), crs.c_str()) != OGRERR_NONE)
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
  const GdalDataSet plain(gdal().GDALOpen(from.c_str(), GA_ReadOnly));
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
  gdal().CPLErrorReset();
  const GdalDataSet data(gdal().GDALOpen(path.c_str(), GA_ReadOnly));
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
