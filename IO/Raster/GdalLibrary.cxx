// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/GdalLibrary.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Query/GisFiles.h"
#include "Raster/RasterFile.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
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

/// Answers each request of GDAL to the network with an error, which GDAL frees.
CPLHTTPResult* refuseNetwork(
  const char*, CSLConstList, GDALProgressFunc, void*, CPLHTTPFetchWriteFunc, void*, void*)
{
  auto* const result = static_cast<CPLHTTPResult*>(std::calloc(1, sizeof(CPLHTTPResult)));
  if (result)
  {
    result->nStatus = 1;
    result->pszErrBuf = strdup("tipp does not use the network");
  }
  return result;
}

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
  functions.CPLHTTPSetFetchCallback(&refuseNetwork, nullptr);
  functions.GDALAllRegister();
  return functions;
}

} // namespace

const GdalLibrary& gdal()
{
  static const GdalLibrary library = openGdal();
  return library;
}

namespace
{

/// The drivers of GDAL that an extension stands for.
struct Drivers
{
  const char* Extension;
  unsigned Flags;
  std::array<const char*, 4> Names; ///< ended by null
};

/// None of these opens files or addresses that are named in a file.
constexpr std::array<Drivers, 13> knownDrivers = { {
  { ".tif", GDAL_OF_RASTER, { "GTiff" } },
  { ".tiff", GDAL_OF_RASTER, { "GTiff" } },
  { ".asc", GDAL_OF_RASTER, { "AAIGrid" } },
  { ".flt", GDAL_OF_RASTER, { "EHdr" } },
  { ".bil", GDAL_OF_RASTER, { "EHdr" } },
  { ".gpkg", GDAL_OF_VECTOR, { "GPKG" } },
  { ".shp", GDAL_OF_VECTOR, { "ESRI Shapefile" } },
  { ".geojson", GDAL_OF_VECTOR, { "GeoJSON" } },
  { ".json", GDAL_OF_VECTOR, { "GeoJSON", "TopoJSON", "ESRIJSON" } },
  { ".fgb", GDAL_OF_VECTOR, { "FlatGeobuf" } },
  { ".kml", GDAL_OF_VECTOR, { "LIBKML", "KML" } },
  { ".dxf", GDAL_OF_VECTOR, { "DXF" } },
  { ".csv", GDAL_OF_VECTOR, { "CSV" } },
} };

/// Opens a file on disk; see openWithGdal().
GdalDataSet openWithDrivers(const std::string& path, unsigned flags, const char* const* drivers)
{
  // A path on disk: GDAL also takes connections ("PG:..."), addresses and its own file systems
  // (/vsicurl/...).
  const std::string onDisk = std::filesystem::absolute(path).lexically_normal().string();
  if (onDisk.compare(0, 4, "/vsi") == 0)
  {
    throw IOError(path, "is not the path of a file on disk.");
  }
  gdal().CPLErrorReset();
  // No .aux.xml beside a raster is read.
  gdal().CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO");
  GdalDataSet data(
    gdal().GDALOpenEx(onDisk.c_str(), flags | GDAL_OF_READONLY, drivers, nullptr, nullptr));
  gdal().CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr);
  return data;
}

} // namespace

GdalDataSet openWithGdal(const std::string& path, unsigned flags)
{
  const std::string extension = extensionOf(path);
  const auto known = std::find_if(knownDrivers.begin(), knownDrivers.end(),
    [&](const Drivers& drivers)
    { return drivers.Flags == flags && drivers.Extension == extension; });
  if (known == knownDrivers.end())
  {
    std::string list;
    for (const Drivers& drivers : knownDrivers)
    {
      list +=
        drivers.Flags == flags ? (list.empty() ? "" : ", ") + std::string(drivers.Extension) : "";
    }
    throw IOError(path,
      std::string("has no extension that tells a kind of ") +
        (flags == GDAL_OF_RASTER ? "raster" : "file of a GIS") + "; use " + list + ".");
  }
  const InputFile exists(path); // throws a better message than GDAL
  return openWithDrivers(path, flags, known->Names.data());
}

namespace
{

/// Returns the radius of the circle through three points, of which the first and the last are equal
/// if the arc is a whole circle; 0 if they lie on a line.
double radiusOf(OGRGeometryH arc, int first)
{
  const auto distance = [&](int i, int j)
  {
    return std::hypot(gdal().OGR_G_GetX(arc, first + i) - gdal().OGR_G_GetX(arc, first + j),
      gdal().OGR_G_GetY(arc, first + i) - gdal().OGR_G_GetY(arc, first + j));
  };
  const double a = distance(0, 1);
  const double b = distance(1, 2);
  const double c = distance(2, 0);
  if (c == 0)
  {
    return a / 2;
  }
  const double s = (a + b + c) / 2;
  const double area = std::sqrt(std::max(s * (s - a) * (s - b) * (s - c), 0.0));
  return area > 0 ? a * b * c / (4 * area) : 0;
}

/// Returns the largest radius of the arcs in a geometry; 0 if there are none.
double largestRadius(OGRGeometryH geometry)
{
  double largest = 0;
  if (gdal().OGR_GT_Flatten(gdal().OGR_G_GetGeometryType(geometry)) == wkbCircularString)
  {
    const int points = gdal().OGR_G_GetPointCount(geometry);
    for (int i = 0; i + 2 < points; i += 2)
    {
      largest = std::max(largest, radiusOf(geometry, i));
    }
    return largest;
  }
  const int parts = gdal().OGR_G_GetGeometryCount(geometry);
  for (int i = 0; i < parts; ++i)
  {
    largest = std::max(largest, largestRadius(gdal().OGR_G_GetGeometryRef(geometry, i)));
  }
  return largest;
}

std::atomic<double> curveTolerance{ 0 };

/// Returns the angle of a segment, in degrees, with which those of the geometry's arcs keep the
/// tolerance; 0: GDAL's default of 4 degrees.
double angleOfSegments(OGRGeometryH geometry)
{
  constexpr double degrees = 180 / 3.14159265358979323846;
  constexpr double least = 360.0 / 1000000; // a million segments for a circle
  constexpr double most = 60;
  const double tolerance = curveTolerance;
  const double radius = tolerance > 0 ? largestRadius(geometry) : 0;
  if (radius == 0)
  {
    return 0;
  }
  // GDAL rounds the number of segments of an arc, so that they may be half as long again.
  constexpr double share = 2.0 / 3;
  const double cosine = std::max(1 - tolerance / radius, 0.0);
  return std::clamp(share * 2 * std::acos(cosine) * degrees, least, most);
}

} // namespace

void setCurveTolerance(double distance)
{
  curveTolerance = distance;
}

void forFeatures(
  const std::string& path, const std::function<void(OGRFeatureH, OGRGeometryH)>& visit)
{
  const GdalDataSet file = openWithGdal(path, GDAL_OF_VECTOR);
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
      const GdalOwner<OGRGeometryH, &GdalLibrary::OGR_G_DestroyGeometry> straight(isCurved
          ? gdal().OGR_G_GetLinearGeometry(geometry, angleOfSegments(geometry), nullptr)
          : nullptr);
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
