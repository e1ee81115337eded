// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattenDataSet_h
#define tippFlattenDataSet_h

#include "Flat/Flattened.h"
#include "vtkTIPPIOModule.h"

#include <string>

class vtkDataSet;

namespace tipp
{

/// Converts a data set's points (float32 if the input's are, else float64), its numeric arrays and
/// its cells: to triangles or, if some cells have a volume, to tetrahedra of positive volume, over
/// its own points. Ghost cells and vtkGhostType are left out. If cells are cut or left out, the
/// cell data "vtkOriginalCellIds" hold the index of each simplex's cell in `data`.
///
/// A face is cut into a fan around its point of lowest id; a volume is cut by joining its point of
/// lowest id to all faces without that point, so that neighbours agree. (Known as pulling;
/// Dompierre and others, "How to Subdivide Pyramids, Prisms, and Hexahedra into Tetrahedra", 1999.)
/// Throws IOError with the path if no cell has an area or a volume, or if a curved cell is not a
/// quadratic triangle or tetrahedron.
VTKTIPPIO_EXPORT Flattened flattenDataSet(vtkDataSet* data, const std::string& path);

} // namespace tipp

#endif
