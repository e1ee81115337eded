// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFinishPieces_h
#define tippFinishPieces_h

#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "Parallel/ParallelFor.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

// Point ids in this header are indices among all spilled points (see SpilledPoints).

/// Returns the result of a piece that is done.
using ResultOf = std::function<const StoredResult&(PartitionIndex)>;

/// Reads the interior of a piece that is done. Throws IOError.
PieceInterior readInterior(const PieceWork& work, PartitionIndex piece, const StoredResult& result);

/// Calls visit(point, row) for points at borders, which are interface points of their pieces.
/// `points` must be ascending. Throws IOError.
void visitBorderRows(const PieceWork& work, const std::vector<std::int64_t>& points,
  const ResultOf& results, const std::function<void(std::int64_t, const double*)>& visit);

/// Sets the rows of the points that a border's triangles use and that other pieces own. Throws
/// IOError.
void setGhosts(const PieceWork& work, const ResultOf& results, PieceBorder& border);

/// Passes to the consumer the triangles between pieces that became final with the last partitions
/// of `piece`. All pieces that conflict with it must be done, because their points may be corners.
/// Throws IOError.
void takeBorder(const PieceWork& work, PartitionIndex piece, const ResultOf& results);

/// Passes to the consumer the triangles at the border of the piece that owns them. Throws IOError.
void takeBorder(
  const PieceWork& work, PartitionIndex piece, PieceBorder& border, const ResultOf& results);

/// Passes triangles at the borders of any pieces to the consumer; `name` identifies this part (see
/// TriangleConsumer::take()). Throws IOError.
void takeTriangles(const PieceWork& work, const std::string& name, const BordersByOwner& triangles,
  const ResultOf& results);

/// Returns whether the first takeBorder() has been completed for a piece, in this process or an
/// earlier one.
bool isBorderTaken(const PieceWork& work, PartitionIndex piece);

/// Finds the pieces whose borders can be passed to the consumer. Pieces may become done in any
/// order.
class BorderQueue
{
public:
  /// `order`: of all partitions; pieces with conflicting partitions are neighbours.
  BorderQueue(const PiecePlan& plan, const PartitionOrder& order);

  /// Call this once for each piece that becomes done. Returns the pieces whose neighbours are now
  /// all done: takeBorder() can be called for them.
  std::vector<PartitionIndex> setDone(PartitionIndex piece);

private:
  std::vector<std::vector<PartitionIndex>> Neighbours; ///< by piece: neighbours, and itself
  std::vector<std::size_t> Open; ///< by piece: the number of its Neighbours that are not done
};

/// Returns for each piece whether an earlier process left its result and its part of the mesh
/// undamaged. Reads all of these files. Removes damaged ones, so that their pieces are made again,
/// and passes a sentence about them to `warn`. Returns an empty list if `report` stopped the run.
std::vector<char> verifyResults(const PieceWork& work, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn);

/// Completes the files of all pieces once all results exist: repairs the hull (Lemma 3), and adds
/// the borders to the interiors. Then only the global ids of cells and of their neighbours are
/// missing. Returns the pieces in the order of the mesh; an empty list if `report` stopped the run.
/// Throws IOError.
std::vector<FinishedPiece> finishPieces(
  const PieceWork& work, int threads, const Report& report, PieceFigures& figures);

/// Writes the global ids of all cells, and sets mesh.Cells to their number. Throws IOError.
void numberCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, const Report& report);

/// Writes the cell array that marks edges of constraints; call it after numberCells(). `array`: its
/// index among the mesh's arrays. `constraints`: null if there are none. Throws IOError.
void markCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::int64_t array,
  const PieceSegments* constraints, int threads, const Report& report);

/// Writes the cell array NeighborIds; call it after numberCells(). Uses as many of the threads as
/// `memory` bytes allow. Throws IOError.
void linkCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::uint64_t memory,
  int threads, const Report& report);

} // namespace tipp

#endif
