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

/// Reads zones with GDAL: one per feature of all layers of a GeoPackage, Shapefile, GeoJSON,
/// FlatGeobuf, or .csv file with a column WKT. Features that are not polygons give zones without
/// rings; a file without any polygon is refused. A zone's name is the feature's value of `field`
/// or, if `field` is empty, its index from 0. Throws IOError.
VTKTIPPIO_EXPORT std::vector<NamedZone> readZones(
  const std::string& path, const std::string& field);

} // namespace tipp

#endif
