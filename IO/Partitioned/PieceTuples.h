// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceTuples_h
#define tippPieceTuples_h

#include "Partitioned/GrowingPiece.h"

#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Whether an array of a growing piece is of global ids of cells, which are known last: there are
/// no data of cells but their neighbours' ids.
inline bool holdsCellIds(const PieceArray& array)
{
  return array.Role == PieceRole::CellIds || array.Role == PieceRole::CellData;
}

/// What an array of points holds of a row.
void copyPiecePoint(const PieceArray& array, const double* row, const PointRowLayout& rows,
  bool isGhost, std::int64_t representative, char* to);

/// Makes room in the bounds for a row's point; coordinates that are not finite take none.
void extendBounds(Bounds& bounds, const double* row, const PointRowLayout& rows);

/// What the arrays `offsets` and `types` hold of triangles in a row.
void fillPieceCells(const PieceArray& array, std::int64_t first, std::size_t count, char* to);

} // namespace tipp

#endif
