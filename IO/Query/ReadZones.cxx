// SPDX-License-Identifier: BSD-3-Clause
#include "Query/ReadZones.h"

#include "Files/IOError.h"
#ifdef TIPP_HAVE_GDAL
#include "Raster/GdalLibrary.h"
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

} // namespace

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
      geometry ? addPolygons(geometry, zone.Polygons) : void();
      hasPolygons = hasPolygons || !zone.Polygons.empty();
      zones.push_back(zone);
    });
  if (!hasPolygons)
  {
    throw IOError(path, "has no polygons; in a .csv file they are in a column WKT.");
  }
  return zones;
}

#else

std::vector<NamedZone> readZones(const std::string& path, const std::string&)
{
  throw IOError(path, "needs GDAL, and this program was built without it.");
}

#endif

} // namespace tipp
