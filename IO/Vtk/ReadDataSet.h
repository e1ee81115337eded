// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadDataSet_h
#define tippReadDataSet_h

#include "Vtk/VtkFiles.h"
#include "vtkTIPPIOModule.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkDataSet;

namespace tipp
{

/// Reads a data set with VTK's readers, and checks it by checkVtkFile() and checkDataSet(). Throws
/// IOError, with VTK's own message if a reader fails.
VTKTIPPIO_EXPORT vtkSmartPointer<vtkDataSet> readDataSet(const std::string& path);

/// The file that readDataSet() is reading; null at other times. VTK's readers trust what they read,
/// so a damaged file can crash them; a program's signal handler can then name the file.
VTKTIPPIO_EXPORT const char* fileBeingRead();

} // namespace tipp

#endif
