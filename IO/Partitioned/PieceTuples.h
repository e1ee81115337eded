// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceTuples_h
#define tippPieceTuples_h

#include "Partitioned/GrowingPiece.h"

#include <cstddef>
#include <cstdint>

namespace tipp
{

/// What an array of points holds of a row.
void copyPiecePoint(const PieceArray& array, const double* row, const PointRowLayout& rows,
  bool isGhost, std::int64_t representative, char* to);

/// Makes room in the bounds for a row's point.
void extendBounds(Bounds& bounds, const double* row, const PointRowLayout& rows);

/// What the arrays `offsets` and `types` hold of triangles in a row.
void fillPieceCells(const PieceArray& array, std::int64_t first, std::size_t count, char* to);

} // namespace tipp

#endif
