// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFinishPieces_h
#define tippFinishPieces_h

#include "OutOfCore/PieceResult.h"
#include "Parallel/ParallelFor.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Returns for each piece whether an earlier process has left its result and its share of the mesh
/// intact; reads all of them. Damaged pieces are removed, so that they are made again, and `warn`
/// gets a sentence about them. Returns an empty list if `report` ended it.
std::vector<char> verifyResults(const PieceWork& work, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn);

/// Completes the files of all pieces when all results are there: repairs the hull (Lemma 3) and
/// adds the borders to the interiors. A piece's file is complete then, except for the global ids of
/// cells and of their neighbours. Returns the pieces by their numbers in the mesh; an empty list if
/// `report` ended it. Throws IOError.
std::vector<FinishedPiece> finishPieces(
  const PieceWork& work, int threads, const Report& report, PieceFigures& figures);

/// Writes the global ids of all cells, and sets mesh.Cells. Throws IOError.
void numberCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, const Report& report);

/// Writes the array that marks edges of constraints, the mesh's array number `array`, after
/// numberCells(). Constraints: null if there are none. Throws IOError.
void markCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::int64_t array,
  const ConstraintSegments* constraints, int threads, const Report& report);

/// Writes the cell array NeighborIds, after numberCells(): by as many threads as `memory` bytes
/// allow. Throws IOError.
void linkCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::uint64_t memory,
  int threads, const Report& report);

} // namespace tipp

#endif
