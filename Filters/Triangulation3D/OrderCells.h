// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOrderCells_h
#define tippOrderCells_h

#include "Arrays/Buffer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Four point ids, in an order whose orientation3() is positive.
using CellIds = std::array<std::int32_t, 4>;

/// Returns all cells in the order of Tetrahedralization, and frees the parts. So the result does
/// not depend on who made which cell, nor when. Ids are below `points`.
Buffer<std::int32_t> orderCells(
  std::vector<std::vector<CellIds>>&& parts, std::size_t points, int threads);

} // namespace tipp

#endif
