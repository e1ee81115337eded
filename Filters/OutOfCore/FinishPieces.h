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

/// The result of a piece that is done.
using ResultOf = std::function<const StoredResult&(PartitionIndex)>;

/// The interior of a piece that is done. Throws IOError.
PieceInterior readInterior(const PieceWork& work, PartitionIndex piece, const StoredResult& result);

/// Visits the rows of points at borders, which are interface points of their own pieces. `points`:
/// ascending. Throws IOError.
void visitBorderRows(const PieceWork& work, const std::vector<std::int64_t>& points,
  const ResultOf& results, const std::function<void(std::int64_t, const double*)>& visit);

/// Sets the rows of the points of other pieces that a border's triangles use. Throws IOError.
void setGhosts(const PieceWork& work, const ResultOf& results, PieceBorder& border);

/// Gives the triangles between pieces that the last partitions of `piece` have completed to the
/// taker. All pieces that conflict with it must be done: their points are corners. Throws IOError.
void takeBorder(const PieceWork& work, PartitionIndex piece, const ResultOf& results);

/// Gives it the triangles at the border of the piece that owns them. Throws IOError.
void takeBorder(
  const PieceWork& work, PartitionIndex piece, PieceBorder& border, const ResultOf& results);

/// Gives it triangles of any pieces; `name`: of this part.
void takeTriangles(const PieceWork& work, const std::string& name, const BordersByOwner& triangles,
  const ResultOf& results);

/// Whether takeBorder() has been completed, in this process or another one.
bool isBorderTaken(const PieceWork& work, PartitionIndex piece);

/// Tells which borders can be taken while pieces get done, in any order.
class BorderQueue
{
public:
  /// Of all partitions, of which conflicting ones are neighbours.
  BorderQueue(const PiecePlan& plan, const PartitionOrder& order);

  /// Call once for each piece that gets done. Returns the pieces whose borders can be taken now.
  std::vector<PartitionIndex> setDone(PartitionIndex piece);

private:
  std::vector<std::vector<PartitionIndex>> Neighbours; ///< of each piece, with itself
  std::vector<std::size_t> Open;                       ///< of these, those that are not done
};

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
  const PieceSegments* constraints, int threads, const Report& report);

/// Writes the cell array NeighborIds, after numberCells(): by as many threads as `memory` bytes
/// allow. Throws IOError.
void linkCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::uint64_t memory,
  int threads, const Report& report);

} // namespace tipp

#endif
