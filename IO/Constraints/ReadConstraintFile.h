// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadConstraintFile_h
#define tippReadConstraintFile_h

#include "Constraints/ConstraintTable.h"
#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Reads constraints by the file's extension:
/// .poly (Triangle: vertices, or those of the .node file beside it, segments and holes);
/// .csv, .txt (a segment a line: x and y, or x, y and z of both ends, or two ids of points counted
/// from 0); .14, .grd (ADCIRC: the boundaries of the grid); .gpkg, .shp, .geojson, .json, .fgb
/// (lines and polygons of a GIS); any VTK file (its lines, and its polygons as polygons). Throws
/// IOError.
VTKTIPPIO_EXPORT ConstraintTable readConstraintFile(const std::string& path);

} // namespace tipp

#endif
