// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClassifyOnThreads_h
#define tippClassifyOnThreads_h

#include "Partition/CellShape.h"

namespace tipp
{

/// Throws the error for the first invalid cell: a coordinate is not finite, or the cell lies
/// outside the domain.
[[noreturn]] void failForCell(const CellShape& shape, std::size_t cell);

/// classifyCells() on OpenMP threads.
Membership classifyOnThreads(
  const CellsView& cells, const BoxTiling& tiling, const CellShape& shape, int threads);

} // namespace tipp

#endif
