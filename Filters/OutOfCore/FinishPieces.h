// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFinishPieces_h
#define tippFinishPieces_h

#include "OutOfCore/PieceResult.h"
#include "Parallel/ParallelFor.h"

#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Of each piece, whether its result and what it has in the mesh are there, as an earlier process
/// left them: all that a run needs to go on. Reads them. What is damaged is removed, and `warn` is
/// told in one sentence: such a piece is made again. Nothing is returned if `report` ended it.
std::vector<char> verifyResults(const PieceWork& work, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn);

/// Completes the files of all pieces when all results are there: repairs the hull (Lemma 3) and
/// adds the borders to the interiors. All of a piece's file is there then but the global ids of
/// cells and of their neighbours. Returns what is known of the pieces, by their numbers in the
/// mesh; nothing if `report` ended it. Throws IOError.
std::vector<FinishedPiece> finishPieces(
  const PieceWork& work, int threads, const Report& report, PieceFigures& figures);

} // namespace tipp

#endif
