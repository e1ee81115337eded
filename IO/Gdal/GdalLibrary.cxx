// SPDX-License-Identifier: BSD-3-Clause
#include "Gdal/GdalLibrary.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
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

GdalDataSet openWithGdal(const std::string& path, unsigned flags)
{
  const bool isRaster = flags == GDAL_OF_RASTER;
  const unsigned use = isRaster ? Use::Rasters : Use::Zones;
  const Format* const format = formatOf(path, use);
  if (!format)
  {
    std::string list;
    for (const std::string& extension : extensionsFor(use))
    {
      list += (list.empty() ? "" : ", ") + extension;
    }
    throw IOError(path,
      std::string("has no extension that tells a kind of ") +
        (isRaster ? "raster" : "file of a GIS") + "; use " + list + ".");
  }
  const InputFile exists(path); // throws a better message than GDAL
  std::istringstream names(format->Drivers);
  std::vector<std::string> drivers;
  for (std::string name; std::getline(names, name, ',');)
  {
    drivers.push_back(name);
  }
  std::vector<const char*> list;
  for (const std::string& name : drivers)
  {
    list.push_back(name.c_str());
  }
  list.push_back(nullptr);
  return openWithDrivers(path, flags, list.data());
}

std::atomic<double> curveTolerance{ 0 };

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

/// Returns the angle in degrees that each segment of an arc may span so that the geometry's arcs
/// are approximated within the tolerance; 0: GDAL's default of 4 degrees.
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

} // namespace tipp
