// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNoVtk_h
#define tippNoVtk_h

#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// In a build without VTK: throws IOError for a file of a mesh that only VTK reads, and says how
/// PyVista makes a partitioned mesh of it.
[[noreturn]] VTKTIPPIO_EXPORT void refuseVtkMesh(const std::string& path);

/// Does the same for a file whose cells are wanted, and says how PyVista writes these.
[[noreturn]] VTKTIPPIO_EXPORT void refuseVtkCells(const std::string& path);

} // namespace tipp

#endif
