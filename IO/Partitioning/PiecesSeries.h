// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPiecesSeries_h
#define tippPiecesSeries_h

#include "Series/MeshSeries.h"
#include "vtkTIPPIOModule.h"

#include <memory>
#include <string>

namespace tipp
{

/// Opens a partitioned mesh of triangles as a MeshSeries, with points and cells by their global
/// ids. Its points and cells, and one array at a time, are in memory. Arrays of several components
/// become a variable for each, with _0, _1 ... after their name; the third coordinate is the
/// variable "elevation". Throws IOError.
VTKTIPPIO_EXPORT std::unique_ptr<MeshSeries> openPiecesSeries(const std::string& path);

} // namespace tipp

#endif
