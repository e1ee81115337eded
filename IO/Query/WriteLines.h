// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteLines_h
#define tippWriteLines_h

#include "Files/OutputPath.h"
#include "Query/Lines.h"
#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Writes contours as a GeoPackage (.gpkg), by GDAL: a layer "contours" of lines in three
/// dimensions with the level as a field of the array's name. `crs` is a reference system as
/// "EPSG:25832", or empty; `before` as for PendingFile. Throws IOError, also in a build without
/// GDAL.
VTKTIPPIO_EXPORT void writeGeoPackage(const std::string& path, const Contours& contours,
  const std::string& array, const std::string& crs, const PathState& before);

} // namespace tipp

#endif
