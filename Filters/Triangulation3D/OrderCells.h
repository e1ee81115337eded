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

/// Merges lists of cells, each in the order of orderCells(), into one.
Buffer<std::int32_t> mergeCells(std::vector<Buffer<char>> parts);

/// Rotates triangles, three point ids each, so that the lowest id is first, and sorts them
/// lexicographically.
void orderTriangles(Buffer<std::int32_t>& ids);
/// Does the same for triangles given as the first three ids of cells, and returns three ids per
/// triangle.
Buffer<std::int32_t> orderTriangles(const std::vector<CellIds>& cells);

} // namespace tipp

#endif
