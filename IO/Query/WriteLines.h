// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteLines_h
#define tippWriteLines_h

#include "Files/OutputPath.h"
#include "Query/Lines.h"
#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Writes contour lines as a GeoPackage (.gpkg) with GDAL: a layer "contours" of lines in three
/// dimensions, and a field with the array's name for the level. `crs` is a reference system, for
/// example "EPSG:25832", or empty. See PendingFile for `before`. Throws IOError, also in a build
/// without GDAL.
VTKTIPPIO_EXPORT void writeGeoPackage(const std::string& path, const Contours& contours,
  const std::string& array, const std::string& crs, const PathState& before);

} // namespace tipp

#endif
