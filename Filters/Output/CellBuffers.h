// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellBuffers_h
#define tippCellBuffers_h

#include "Triangulation/Buffer.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <limits>

class vtkCellArray;

namespace tipp
{

/// Returns cells of `cellSize` point ids each that take over the memory of `ids`. 32-bit ids give
/// 32-bit cells unless the last offset exceeds `largestOffset32`: VTK stores ids and offsets in one
/// type, so they are then copied to 64 bits.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int32_t> ids,
  int cellSize, std::int64_t largestOffset32 = std::numeric_limits<std::int32_t>::max());
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(
  Buffer<std::int64_t> ids, int cellSize);

} // namespace tipp

#endif
