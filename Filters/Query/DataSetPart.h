// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataSetPart_h
#define tippDataSetPart_h

#include "Query/MeshPart.h"
#include "vtkTIPPFiltersModule.h"

class vtkDataObject;

namespace tipp
{

/// The tetrahedra or, if there are none, the triangles of a vtkPointSet with its arrays, for
/// queries. Other cells are cut into these; cells that vtkGhostType hides are left out. Shares the
/// data set's memory where it can, and keeps the data set. Global ids of cells and points are those
/// of the data set, if it has some. A composite data set may have one vtkPointSet with cells. Null
/// or without cells: an empty mesh. Throws std::runtime_error with one sentence if the data cannot
/// be used.
VTKTIPPFILTERS_EXPORT MeshPart partOf(vtkDataObject* data, int threads);

} // namespace tipp

#endif
