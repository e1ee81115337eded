// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellBuffers_h
#define tippCellBuffers_h

#include "Arrays/Buffer.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <limits>

class vtkCellArray;
class vtkIdTypeArray;

namespace tipp
{

/// Returns cells of `cellSize` point ids each that take over the memory of `ids`. 32-bit ids give
/// 32-bit cells unless the last offset exceeds `largestOffset32`: VTK stores ids and offsets in one
/// type, so they are then copied to 64 bits.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int32_t> ids,
  int cellSize, std::int64_t largestOffset32 = std::numeric_limits<std::int32_t>::max());
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(
  Buffer<std::int64_t> ids, int cellSize);

/// Returns the array "NeighborIds": for each corner of a triangle the index of the triangle across
/// the opposite edge, or -1.
vtkSmartPointer<vtkIdTypeArray> neighborArray(const Triangulation& triangulation);

/// Returns for each of `points` input points the id of its representative: its own id, for a
/// duplicate the representative's, for a rejected point -1.
vtkSmartPointer<vtkIdTypeArray> representativeIds(
  const Triangulation& triangulation, std::int64_t points);

} // namespace tipp

#endif
