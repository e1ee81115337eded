// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfCrs_h
#define tippNetcdfCrs_h

#include "Netcdf/NetcdfOutput.h"

#include <string>

namespace tipp
{

/// @name Reference systems in NetCDF files in the manner of CF, as GDAL and rioxarray read them
/// `wkt`: in version 1 of WKT; empty: none.
///@{
bool isGeographicWkt(const std::string& wkt);
/// Says of two variables that they are coordinates in the system.
void describeAxes(const NetcdfOutput& output, int x, int y, const std::string& wkt);
/// Adds the variable "crs", which data name as their grid_mapping.
void defineCrs(const NetcdfOutput& output, const std::string& wkt);
///@}

} // namespace tipp

#endif
