// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGisFiles_h
#define tippGisFiles_h

#include "Files/PendingOutput.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// A closed polygon in x and y. The last corner is connected to the first, or equals it.
struct ZoneRing
{
  std::vector<Point2> Corners;
  bool IsHole = false;
};

template <typename Archive>
void serialize(Archive& archive, ZoneRing& ring)
{
  archive(ring.Corners, ring.IsHole);
}

/// One or several polygons with holes.
using Zone = std::vector<ZoneRing>;

/// A zone of a file.
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

/// Sets how far the segments that replace the curves of GIS files may be from them, in the units of
/// the file, for all files that this process reads from now on. 0, the default: a segment for each
/// 4 degrees of an arc.
VTKTIPPIO_EXPORT void setCurveTolerance(double distance);

/// Contour lines as polylines: line i has the points Starts[i] ... Starts[i + 1] - 1. The last
/// point of a closed line equals its first.
struct Contours
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<double> Levels; ///< level of each line
  std::vector<Point3> Points;
};

/// Writes contour lines as a GeoPackage (.gpkg) with GDAL: a layer "contours" of lines in three
/// dimensions, and a field with the array's name for the level. `crs` is a reference system, for
/// example "EPSG:25832", or empty. See PendingFile for `before`. Throws IOError, also in a build
/// without GDAL.
VTKTIPPIO_EXPORT void writeGeoPackage(const std::string& path, const Contours& contours,
  const std::string& array, const std::string& crs, const PathState& before);

} // namespace tipp

#endif
