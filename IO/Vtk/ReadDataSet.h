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

/// Reads a data set with VTK's readers. Throws IOError, with VTK's own words if they fail. The file
/// and the data set have passed checkVtkFile() and checkDataSet().
VTKTIPPIO_EXPORT vtkSmartPointer<vtkDataSet> readDataSet(const std::string& path);

/// The file that readDataSet is reading, null at other times. VTK's readers trust what they read,
/// so a damaged file can crash them; a program's signal handler can then say which file it was.
VTKTIPPIO_EXPORT const char* fileBeingRead();

} // namespace tipp

#endif
