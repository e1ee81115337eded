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

/// Returns the cells of all parts in the order of Tetrahedralization::Ids, and frees the parts. The
/// result does not depend on how cells are divided among the parts. `points`: all ids are below it.
Buffer<std::int32_t> orderCells(
  std::vector<std::vector<CellIds>>&& parts, std::size_t points, int threads);

} // namespace tipp

#endif
