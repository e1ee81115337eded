// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataSetPart_h
#define tippDataSetPart_h

#include "Query/MeshPart.h"
#include "vtkTIPPFiltersModule.h"

class vtkDataObject;

namespace tipp
{

/// The tetrahedra or, if there are none, the triangles of a vtkPointSet with its arrays, for
/// queries. Other cells are divided into these; cells that vtkGhostType hides are left out. The
/// result shares the data set's memory where possible, and holds a reference to the data set.
/// Global ids of cells and points are those of the data set, if it has any. A composite data set
/// may have only one vtkPointSet with cells. If `data` is null or has no cells, the mesh is empty.
/// Throws std::runtime_error, with one sentence, if the data cannot be used.
VTKTIPPFILTERS_EXPORT MeshPart partOf(vtkDataObject* data, int threads);

} // namespace tipp

#endif
