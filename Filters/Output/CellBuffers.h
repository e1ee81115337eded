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

/// Cells of `cellSize` point ids each over the very memory of `ids`. Ids of 32 bits make 32-bit
/// cells unless the last offset exceeds `largestOffset32`, for VTK stores ids and offsets in one
/// type; they are copied into 64 bits then.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int32_t> ids,
  int cellSize,
  std::int64_t largestOffset32 = std::numeric_limits<std::int32_t>::max());
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int64_t> ids,
  int cellSize);

} // namespace tipp

#endif
