// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceNeighbors_h
#define tippPieceNeighbors_h

#include "Resident/ResidentMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Computes the neighbours of cells that are grouped by the pieces that own them: for each cell,
/// and each of its corners, the id of the cell across the face opposite to this corner. -1 if there
/// is none; the lowest id if there are several. Throws IOError, and WorkAborted.
VTKTIPPIO_EXPORT std::vector<std::int64_t> computedNeighbors(
  const ResidentMesh& mesh, const PieceGroups& groups, const std::vector<std::int64_t>& cells);

/// The cells that a piece owns, and their neighbours.
struct OwnedNeighbors
{
  std::vector<std::int64_t> Cells;     ///< global ids
  std::vector<std::int64_t> Neighbors; ///< CellSize of each
};

/// The neighbours of all cells of a piece, computed from the cells even if the mesh stores
/// neighbour ids.
OwnedNeighbors neighborsInPiece(const ResidentMesh& mesh, std::size_t piece);

} // namespace tipp

#endif
