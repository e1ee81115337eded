// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceTuples_h
#define tippPieceTuples_h

#include "Partitioned/GrowingPiece.h"

#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Whether an array of a growing piece holds global ids of cells, which are known last: no cell
/// data are stored but the neighbours' ids.
inline bool holdsCellIds(const PieceArray& array)
{
  return array.Role == PieceRole::CellIds || array.Role == PieceRole::CellData;
}

/// Copies a row's values of a point array.
void copyPiecePoint(const PieceArray& array, const double* row, const PointRowLayout& rows,
  bool isGhost, std::int64_t representative, char* to);

/// Extends the bounds by a row's point; coordinates that are not finite are ignored.
void extendBounds(Bounds& bounds, const double* row, const PointRowLayout& rows);

/// Fills the arrays `offsets` and `types` for `count` consecutive triangles.
void fillPieceCells(const PieceArray& array, std::int64_t first, std::size_t count, char* to);

} // namespace tipp

#endif
