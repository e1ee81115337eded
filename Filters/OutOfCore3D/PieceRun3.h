// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceRun3_h
#define tippPieceRun3_h

#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore3D/PiecePlan3.h"
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

/// Adds border tetrahedra to those of the piece that owns them: the first in the mesh of the pieces
/// that a tetrahedron meets. The others borrow it.
class VTKTIPPFILTERS_EXPORT BorderSorter3
{
public:
  explicit BorderSorter3(const PiecePlan3& plan)
    : Plan(plan)
  {
  }

  /// Returns the pieces that the tetrahedron meets, as indices in the mesh, ascending. Valid until
  /// the next call.
  const std::vector<std::int32_t>& findMet(const std::array<Vertex3, 4>& corners);
  /// Adds the tetrahedron to `borders`. `met`: the result of findMet().
  void add(const std::array<Vertex3, 4>& corners, const std::vector<std::int32_t>& met,
    BordersByOwner3& borders) const;

private:
  const PiecePlan3& Plan;
  std::vector<std::int32_t> Met;
};

/// Triangulates all pieces that are not done, as many at a time as fit in memory, in threads, and
/// writes their results. `isDone` has an entry for each piece. `progress` is called with the number
/// of finished points, by one thread at a time; false stops the run. Returns false if it was
/// stopped. Throws IOError.
VTKTIPPFILTERS_EXPORT bool triangulatePieces(const PieceWork3& work, const MemoryPlan3& memory,
  int threads, const std::function<bool(std::int64_t)>& progress, const std::vector<char>& isDone);

/// Completes the files of all pieces once all results exist: repairs the hull (Lemma 3), and adds
/// the borders to the interiors, unless an earlier process did so. Then only the global ids of
/// cells and of their neighbours are missing. `limit`: bytes of memory for the hull repair. Returns
/// the pieces in the order of the mesh. `report` throws to stop the run. Throws IOError.
VTKTIPPFILTERS_EXPORT std::vector<FinishedPiece> finishPieces(const PieceWork3& work,
  std::uint64_t limit, int threads, const Report& report, PieceFigures& figures);

} // namespace tipp

#endif
