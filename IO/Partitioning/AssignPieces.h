// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAssignPieces_h
#define tippAssignPieces_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Gives out pieces, which are numbered along the Morton curve, as one run of successive pieces a
/// rank, so that the heaviest run is as light as can be. Returns ranks + 1 numbers: rank r has the
/// pieces from result[r] to before result[r + 1]. Ranks beyond the number of pieces get empty runs;
/// no other run is empty. Negative weights count as 0; ranks below 1 as 1.
VTKTIPPIO_EXPORT std::vector<std::size_t> assignPieces(
  const std::vector<std::int64_t>& weights, int ranks);

} // namespace tipp

#endif
