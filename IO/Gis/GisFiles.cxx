// SPDX-License-Identifier: BSD-3-Clause
#include "Gis/GisFiles.h"

#include "Files/IOError.h"
#ifdef TIPP_HAVE_GDAL
#include "Crs/ImportCrs.h"
#include "Gdal/GdalLibrary.h"
#endif

namespace tipp
{

#ifdef TIPP_HAVE_GDAL

namespace
{

void addPolygons(OGRGeometryH geometry, Zone& zone)
{
  const bool isPolygon =
    gdal().OGR_GT_Flatten(gdal().OGR_G_GetGeometryType(geometry)) == wkbPolygon;
  const int parts = gdal().OGR_G_GetGeometryCount(geometry);
  for (int i = 0; i < parts; ++i)
  {
    const OGRGeometryH part = gdal().OGR_G_GetGeometryRef(geometry, i);
    if (!isPolygon)
    {
      addPolygons(part, zone);
      continue;
    }
    ZoneRing ring;
    ring.IsHole = i > 0;
    const int corners = gdal().OGR_G_GetPointCount(part);
    for (int k = 0; k < corners; ++k)
    {
      ring.Corners.push_back({ gdal().OGR_G_GetX(part, k), gdal().OGR_G_GetY(part, k) });
    }
    zone.push_back(ring);
  }
}

/// GDAL writes the file in memory; the complete file is then written to its path.
constexpr const char* memoryPath = "/vsimem/contours.gpkg";

[[noreturn]] void refusePackage(const std::string& path)
{
  const std::string reason = gdal().CPLGetLastErrorMsg();
  throw IOError(path,
    "cannot be written as a GeoPackage" + (reason.empty() ? std::string() : " (" + reason + ")") +
      ".");
}

void addLine(OGRLayerH layer, const Contours& contours, std::size_t line, const std::string& path)
{
  const OGRFeatureH feature = gdal().OGR_F_Create(gdal().OGR_L_GetLayerDefn(layer));
  gdal().OGR_F_SetFieldDouble(feature, 0, contours.Levels[line]);
  const OGRGeometryH geometry = gdal().OGR_G_CreateGeometry(wkbLineString25D);
  for (std::int64_t i = contours.Starts[line]; i < contours.Starts[line + 1]; ++i)
  {
    const Point3& p = contours.Points[std::size_t(i)];
    gdal().OGR_G_AddPoint(geometry, p.x, p.y, p.z);
  }
  gdal().OGR_F_SetGeometryDirectly(feature, geometry);
  const bool isAdded = gdal().OGR_L_CreateFeature(layer, feature) == OGRERR_NONE;
  gdal().OGR_F_Destroy(feature);
  if (!isAdded)
  {
    refusePackage(path);
  }
}

void makePackage(const Contours& contours, const std::string& array, const std::string& crs,
  const std::string& path)
{
  const GdalReference reference = crs.empty() ? nullptr : importUserCrs(crs);
  if (!crs.empty() && !reference)
  {
    throw IOError("'" + crs + "' is no coordinate reference system that GDAL knows.");
  }
  const GdalDataSet data(gdal().GDALCreate(
    gdal().GDALGetDriverByName("GPKG"), memoryPath, 0, 0, 0, GDT_Unknown, nullptr));
  const OGRLayerH layer = data ? gdal().GDALDatasetCreateLayer(data.get(), "contours",
                                   reference.get(), wkbLineString25D, nullptr)
                               : nullptr;
  if (!layer)
  {
    refusePackage(path);
  }
  const OGRFieldDefnH field = gdal().OGR_Fld_Create(array.c_str(), OFTReal);
  const bool hasField = gdal().OGR_L_CreateField(layer, field, 1) == OGRERR_NONE;
  gdal().OGR_Fld_Destroy(field);
  if (!hasField || gdal().GDALDatasetStartTransaction(data.get(), 0) != OGRERR_NONE)
  {
    refusePackage(path);
  }
  for (std::size_t line = 0; line < contours.Levels.size(); ++line)
  {
    addLine(layer, contours, line, path);
  }
  if (gdal().GDALDatasetCommitTransaction(data.get()) != OGRERR_NONE)
  {
    refusePackage(path);
  }
}

} // namespace

void setCurveTolerance(double distance)
{
  curveTolerance = distance;
}

std::vector<NamedZone> readZones(const std::string& path, const std::string& field)
{
  std::vector<NamedZone> zones;
  bool hasPolygons = false;
  forFeatures(path,
    [&](OGRFeatureH feature, OGRGeometryH geometry)
    {
      NamedZone zone;
      zone.Name = std::to_string(zones.size());
      if (!field.empty())
      {
        const int column = gdal().OGR_F_GetFieldIndex(feature, field.c_str());
        if (column < 0)
        {
          throw IOError(path, "has no field '" + field + "'.");
        }
        zone.Name = gdal().OGR_F_GetFieldAsString(feature, column);
      }
      if (geometry)
      {
        addPolygons(geometry, zone.Polygons);
      }
      hasPolygons = hasPolygons || !zone.Polygons.empty();
      zones.push_back(zone);
    });
  if (!hasPolygons)
  {
    throw IOError(path, "has no polygons; in a .csv file they are in a column WKT.");
  }
  return zones;
}

void writeGeoPackage(const std::string& path, const Contours& contours, const std::string& array,
  const std::string& crs, const PathState& before)
{
  PendingFile pending(path, before);
  gdal().CPLErrorReset();
  makePackage(contours, array, crs, path);
  vsi_l_offset size = 0;
  const GByte* const bytes = gdal().VSIGetMemFileBuffer(memoryPath, &size, 0);
  if (!bytes)
  {
    refusePackage(path);
  }
  pending.file().write(0, reinterpret_cast<const char*>(bytes), std::size_t(size));
  gdal().VSIUnlink(memoryPath);
  pending.commit();
}

#else

void setCurveTolerance(double) {}

std::vector<NamedZone> readZones(const std::string& path, const std::string&)
{
  throw IOError(path,
    "needs GDAL, and this program was built without it; build it with GDAL (Debian's "
    "libgdal-dev).");
}

void writeGeoPackage(const std::string& path, const Contours&, const std::string&,
  const std::string&, const PathState&)
{
  throw IOError(path, "is a GeoPackage, which needs a TIPP with GDAL; write a .vtp file.");
}

#endif

} // namespace tipp
