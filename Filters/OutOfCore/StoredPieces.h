// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStoredPieces_h
#define tippStoredPieces_h

#include "Parallel/ParallelFor.h"
#include "Partitioned/PieceBorder.h"
#include "Partitioned/PieceWriter.h"
#include "Triangulation/Tiling.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// @file
/// What an earlier process has left of a run's pieces, of triangles or tetrahedra.

/// The files of a piece, besides its share of the mesh.
struct StoredPiece
{
  std::size_t Number;   ///< the piece's index in the mesh
  std::string Result;   ///< a SectionFile: the piece's own points are triangulated
  std::string Finished; ///< of finishOnce(): its border is written, too
};

/// Returns for each piece whether an earlier process has left its result and its share of the mesh
/// intact; reads all of them. Damaged pieces are removed, so that they are made again, and `warn`
/// gets a sentence about them. `interior` reads the interior of a piece. Returns an empty list if
/// `report` ended it.
std::vector<char> verifyPieces(const PartitionedMesh& mesh, const std::vector<StoredPiece>& pieces,
  const std::function<PieceInterior(PartitionIndex)>& interior, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn);

/// The files of all pieces of a PieceWork or a PieceWork3, by their indices in the plan.
template <typename Work>
std::vector<StoredPiece> storedPieces(const Work& work)
{
  std::vector<StoredPiece> pieces;
  for (PartitionIndex piece = 0; piece < work.Plan.pieces(); ++piece)
  {
    pieces.push_back({ work.Plan.number(piece), work.resultPath(piece), work.finishedPath(piece) });
  }
  return pieces;
}

/// Reads the finished piece from its record at `path`; if there is none, finishes the piece and
/// writes the record. Throws IOError.
FinishedPiece finishOnce(const std::string& path, const std::function<FinishedPiece()>& finish);

} // namespace tipp

#endif
