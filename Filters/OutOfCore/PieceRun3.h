// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceRun3_h
#define tippPieceRun3_h

#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/PiecePlan3.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore/PieceRun.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation3D/Dataflow3.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

using BorderCells3 = BorderCells<4>;
using BordersByOwner3 = BordersOf<4>;
using PieceResult3 = PieceResultOf<4, VertexMessage3>;
using StoredResult3 = StoredResultOf<4, VertexMessage3>;
using PieceWork3 = PieceWorkOf<PiecePlan3, StoredResult3>;

/// Triangulates this rank's pieces that are not done, as many at a time as fit in memory, and
/// writes their results. Otherwise like triangulatePieces() for pieces of triangles.
VTKTIPPFILTERS_EXPORT void triangulatePieces(const PieceWork3& work, const MemoryPlan3& memory,
  int threads, const std::function<bool(double)>& progress, Communicator& ranks,
  const std::vector<char>& isDone);

/// Like finishPieces() for pieces of triangles. `limit`: bytes of memory for the hull repair.
/// Throws IOError.
VTKTIPPFILTERS_EXPORT std::vector<FinishedPiece> finishPieces(const PieceWork3& work,
  std::uint64_t limit, int threads, const Report& report, PieceFigures& figures);

} // namespace tipp

#endif
