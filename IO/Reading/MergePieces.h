// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMergePieces_h
#define tippMergePieces_h

#include "Partitioned/ReadPiece.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A cell of one of several pieces, by its index in the piece.
struct CellOfPiece
{
  std::size_t Piece;
  std::int64_t Cell;
};

/// Builds one piece from cells of several pieces, with each point once, identified by its global
/// id. A point is a ghost only if it is one in all pieces that have it. `allPoints` also keeps the
/// pieces' own points that no cell uses.
Piece gatherCells(const std::vector<const Piece*>& pieces, const std::vector<CellOfPiece>& owned,
  const std::vector<CellOfPiece>& ghosts, bool allPoints);

/// Merges pieces; cells are in the pieces' order. A cell that one of them owns is no ghost.
Piece mergePieces(const std::vector<const Piece*>& pieces);

} // namespace tipp

#endif
