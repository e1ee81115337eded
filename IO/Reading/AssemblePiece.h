// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAssemblePiece_h
#define tippAssemblePiece_h

#include "Partitioned/ReadPiece.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A cell of one of several pieces.
struct CellOfPiece
{
  std::size_t Piece;
  std::int64_t Cell;
};

/// One piece of some cells of several, with each point once, known by its global id. A point is no
/// ghost in it if it is none in one of the pieces. `allPoints` keeps those of the pieces' own
/// points, too, that no cell uses.
Piece assemblePiece(const std::vector<const Piece*>& pieces, const std::vector<CellOfPiece>& owned,
  const std::vector<CellOfPiece>& ghosts, bool allPoints);

/// The pieces as one, cells in the pieces' order. A cell that one of them owns is no ghost.
Piece mergePieces(const std::vector<const Piece*>& pieces);

} // namespace tipp

#endif
