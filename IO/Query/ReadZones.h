// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadZones_h
#define tippReadZones_h

#include "Query/ZoneShape.h"
#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

struct NamedZone
{
  std::string Name;
  Zone Polygons;
};

/// Reads a zone of each feature of all layers of a GeoPackage, Shapefile, GeoJSON, FlatGeobuf, or
/// .csv file with a column WKT, by GDAL. Features that are no polygons have no rings. The name is
/// the value of `field`, or, if that is empty, the feature's number from 0. Throws IOError.
VTKTIPPIO_EXPORT std::vector<NamedZone> readZones(
  const std::string& path, const std::string& field);

} // namespace tipp

#endif
