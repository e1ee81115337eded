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
/// Files of a run's pieces, of triangles or tetrahedra, that an earlier process left.

/// The paths of a piece's files, besides its part of the mesh.
struct StoredPiece
{
  std::size_t Number;   ///< the piece's index in the mesh
  std::string Result;   ///< the SectionFile written when the piece's own points are triangulated
  std::string Finished; ///< the record of finishOnce(), written when the border is written, too
};

/// Returns for each piece whether an earlier process left its result and its part of the mesh
/// undamaged. Reads all of these files. Removes damaged ones, so that their pieces are made again,
/// and passes a sentence about them to `warn`. `interior`: reads the interior of a piece. Returns
/// an empty list if `report` stopped the run.
std::vector<char> verifyPieces(const PartitionedMesh& mesh, const std::vector<StoredPiece>& pieces,
  const std::function<PieceInterior(PartitionIndex)>& interior, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn);

/// The same for a PieceWork or PieceWork3.
template <typename Work>
std::vector<char> verifyResults(const Work& work, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn)
{
  std::vector<StoredPiece> pieces;
  pieces.reserve(std::size_t(work.Plan.pieces()));
  for (PartitionIndex piece = 0; piece < work.Plan.pieces(); ++piece)
  {
    pieces.push_back({ work.Plan.number(piece), work.resultPath(piece), work.finishedPath(piece) });
  }
  return verifyPieces(
    work.Mesh, pieces,
    [&](PartitionIndex piece) {
      return typename Work::Result(work.resultPath(piece)).readInterior(work.Points, piece, true);
    },
    threads, report, warn);
}

/// Reads a finished piece from its record at `path`. If there is no record, calls finish() and
/// writes its result as the record. Throws IOError.
FinishedPiece finishOnce(const std::string& path, const std::function<FinishedPiece()>& finish);

} // namespace tipp

#endif
