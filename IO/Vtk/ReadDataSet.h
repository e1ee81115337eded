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

/// Reads the headers in a VTK file, XML or legacy, and throws IOError if they give counts that the
/// file's size cannot hold: VTK's readers would allocate that much memory, or loop that often. Of a
/// parallel file its pieces' files are checked, too. Files of other kinds are accepted.
VTKTIPPIO_EXPORT void checkVtkFile(const std::string& path);

/// Implements checkVtkFile() for a legacy file (.vtk). It also traverses the cells of a file before
/// version 5, whose counts VTK does not check.
void checkLegacyFile(const std::string& path);

/// Checks of VTK data sets. Every data set, from a file or from a pipeline, must pass one of them
/// before its ids are used. They throw IOError with one sentence that begins with `name`: a file,
/// or "the input".
/// @{ Checks the points, and that no point array has fewer tuples than there are points.
VTKTIPPIO_EXPORT void checkPoints(vtkDataSet* data, const std::string& name);

/// Checks the cells: offsets ascend and end within the vertex ids, types are known and fit the
/// number of vertices, and all ids are of points that exist. A data set that has not been modified
/// since its last check is not checked again. `threads` = 0 is OpenMP's default.
VTKTIPPIO_EXPORT void checkCells(vtkDataSet* data, const std::string& name, int threads = 0);

/// Checks points and cells, and that no cell array has fewer tuples than there are cells.
VTKTIPPIO_EXPORT void checkDataSet(vtkDataSet* data, const std::string& name, int threads = 0);
///@}

/// Whether all coordinates are finite. A positive result is cached as by checkCells().
VTKTIPPIO_EXPORT bool allPointsFinite(vtkDataSet* data, int threads = 0);

} // namespace tipp

#endif
