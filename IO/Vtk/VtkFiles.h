// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtkFiles_h
#define tippVtkFiles_h

#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Whether VTK reads files with this extension: .vtp .vtu .vti .vts .vtr and their parallel kinds
/// (.pvtp ...), .vtk, .ply, .stl, .obj.
VTKTIPPIO_EXPORT bool isVtkFile(const std::string& path);

/// Reads the points of such a file, as pointsOf() returns them. Throws IOError, also in a build
/// without VTK.
VTKTIPPIO_EXPORT PointTable readVtkPoints(const std::string& path);

} // namespace tipp

#endif
