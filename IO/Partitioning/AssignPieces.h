// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAssignPieces_h
#define tippAssignPieces_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Assigns each rank a run of consecutive pieces, which are numbered along the Morton curve, so
/// that the heaviest run is as light as possible. Returns ranks + 1 numbers: rank r has pieces
/// [result[r], result[r + 1]). If there are more ranks than pieces, the last ranks get empty runs;
/// no other run is empty. Negative weights count as 0; `ranks` below 1 as 1.
VTKTIPPIO_EXPORT std::vector<std::size_t> assignPieces(
  const std::vector<std::int64_t>& weights, int ranks);

} // namespace tipp

#endif
