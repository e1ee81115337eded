// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClassifyOnThreads_h
#define tippClassifyOnThreads_h

#include "Partition/CellShape.h"

namespace tipp
{

/// Tells of the first cell that has no place in the tiling: a coordinate is not finite, or all of
/// it lies outside.
[[noreturn]] void failForCell(const CellShape& shape, std::size_t cell);

/// classifyCells() on OpenMP threads.
Membership classifyOnThreads(
  const CellsView& cells, const BoxTiling& tiling, const CellShape& shape, int threads);

} // namespace tipp

#endif
