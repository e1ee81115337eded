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

/// Merges lists of cells that are in this order each, and frees them.
Buffer<std::int32_t> mergeCells(std::vector<Buffer<char>> parts);

/// Sorts triangles, three point ids each, by their ids, and rotates each so that its lowest id is
/// first.
void orderTriangles(Buffer<std::int32_t>& ids);
/// The same of the first three ids of cells.
Buffer<std::int32_t> orderTriangles(const std::vector<CellIds>& cells);

} // namespace tipp

#endif
