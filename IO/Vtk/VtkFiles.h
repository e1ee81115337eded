// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtkFiles_h
#define tippVtkFiles_h

#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

#include <string>

class vtkDataSet;

namespace tipp
{

/// VTK's name of a cell type; its number in a build without VTK.
VTKTIPPIO_EXPORT std::string cellTypeName(int type);

/// Whether VTK reads files with this extension: .vtp .vtu .vti .vts .vtr and their parallel kinds
/// (.pvtp ...), .vtk, .ply, .stl, .obj.
VTKTIPPIO_EXPORT bool isVtkFile(const std::string& path);

/// Reads the points of such a file as pointsOf() returns them. Throws IOError if reading fails, and
/// always in a build without VTK.
VTKTIPPIO_EXPORT PointTable readVtkPoints(const std::string& path);

/// Converts a data set's points and numeric point data to a table with a column z; an array of
/// several components becomes columns name_0, name_1 ... ...
VTKTIPPIO_EXPORT PointTable pointsOf(vtkDataSet* data);

} // namespace tipp

#endif
