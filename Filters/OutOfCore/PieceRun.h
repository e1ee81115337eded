// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceRun_h
#define tippPieceRun_h

#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "Ranks/Communicator.h"

#include <functional>
#include <vector>

namespace tipp
{

///@{
/// Triangulates this rank's pieces that are not done, and writes their results. `isDone` has an
/// entry for each piece, the same on all ranks. `progress` is called with the fraction of the
/// points that are triangulated, in the calling thread; false stops the run. May be empty. The
/// first rank returns when all ranks' pieces are done, the others when their own are. Throws
/// IOError, and RankFailure, also if `progress` stopped the run.
VTKTIPPFILTERS_EXPORT void triangulatePieces(const PieceWork& work, const MemoryPlan& memory,
  int threads, const std::function<bool(double)>& progress, Communicator& ranks,
  const std::vector<char>& isDone);
VTKTIPPFILTERS_EXPORT void triangulatePieces(const PieceWork3& work, const MemoryPlan3& memory,
  int threads, const std::function<bool(double)>& progress, Communicator& ranks,
  const std::vector<char>& isDone);
///@}

} // namespace tipp

#endif
