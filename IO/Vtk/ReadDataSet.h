// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadDataSet_h
#define tippReadDataSet_h

#include "vtkSmartPointer.h"
#include "vtkTIPPIOModule.h"

#include <string>

class vtkDataSet;

namespace tipp
{

/// Whether readDataSet knows the extension: .vtp .vtu .vti .vts .vtr and their parallel kinds
/// (.pvtp ...), .vtk, .ply, .stl, .obj.
VTKTIPPIO_EXPORT bool isVtkFile(const std::string& path);

/// Reads a data set with VTK's readers; throws IOError with VTK's own words if they fail.
VTKTIPPIO_EXPORT vtkSmartPointer<vtkDataSet> readDataSet(const std::string& path);

} // namespace tipp

#endif
