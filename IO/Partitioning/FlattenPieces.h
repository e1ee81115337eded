// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattenPieces_h
#define tippFlattenPieces_h

#include "Flat/FlatMesh.h"
#include "Partitioned/PartitionedMesh.h"
#include "vtkTIPPIOModule.h"

namespace tipp
{

/// Joins the pieces of a mesh: its points and cells in the order of their global ids. Points and
/// cells are in memory; arrays are read when they are written, one step of one at a time, so that
/// `mesh` must outlive the content. Throws IOError.
VTKTIPPIO_EXPORT FlatContent flattenPieces(const PartitionedMesh& mesh);

} // namespace tipp

#endif
