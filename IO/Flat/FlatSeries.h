// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatSeries_h
#define tippFlatSeries_h

#include "Series/MeshSeries.h"
#include "vtkTIPPIOModule.h"

#include <memory>
#include <string>

namespace tipp
{

/// Opens a flat mesh (see openFlatMesh()) of triangles as a MeshSeries. Arrays of several
/// components become a variable for each, with _0, _1 ... after their name, unless the mesh's
/// description names them; one at the cells that
/// has the name of one at the points gets _cells after it; a third coordinate of the points is the
/// variable "elevation". Values that the description calls missing are NaN. Throws IOError.
VTKTIPPIO_EXPORT std::unique_ptr<MeshSeries> openFlatSeries(const std::string& path);

} // namespace tipp

#endif
