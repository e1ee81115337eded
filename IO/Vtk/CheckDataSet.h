// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckDataSet_h
#define tippCheckDataSet_h

#include "vtkTIPPIOModule.h"

#include <string>

class vtkDataSet;

namespace tipp
{

/// Every VTK data set, from a file or from a pipeline, passes one of these checks before its ids
/// are used. They throw IOError with one sentence that begins with `name`: a file, or "the input".
///@{
/// The points, and that no point array has fewer tuples than there are points.
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
