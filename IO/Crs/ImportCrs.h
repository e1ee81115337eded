// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippImportCrs_h
#define tippImportCrs_h

#include "Crs/CrsRecords.h"
#include "Gdal/GdalLibrary.h"

#include <string>

namespace tipp
{

/// @name Coordinate reference systems
/// All return null if the system is not understood.
///@{
/// Imports "EPSG:code", "EPSG:code+code", WKT or PROJJSON. Text from files: nothing is opened or
/// fetched.
GdalReference importCrs(const std::string& text);
/// Imports any text that GDAL understands, which may be the name of a file. For text that the user
/// gave.
GdalReference importUserCrs(const std::string& text);
/// Imports the horizontal system that GeoTIFF's keys describe.
GdalReference importGeoKeys(const CrsRecords& records);
///@}

/// Exports a system as WKT of 2019 or as another `format` of GDAL; empty if it cannot be expressed.
std::string wktOf(OGRSpatialReferenceH system, const char* format = "WKT2_2019");

} // namespace tipp

#endif
