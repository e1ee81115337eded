// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceRun3_h
#define tippPieceRun3_h

#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore3D/PiecePlan3.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioned/PartitionedMesh.h"
#include "Triangulation3D/Dataflow3.h"
#include "vtkTIPPFiltersModule.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace tipp
{

class ReadyPartitions;

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

/// Loads pieces, as many at a time as fit in memory, triangulates them in threads, and writes their
/// results.
class VTKTIPPFILTERS_EXPORT PieceRun3
{
public:
  /// `progress` is called with the number of finished points, by one thread at a time; false stops
  /// the run. `work` is copied; `memory` and the objects that `work` refers to must outlive this
  /// object.
  PieceRun3(const PieceWork3& work, const MemoryPlan3& memory, int threads,
    std::function<bool(std::int64_t)> progress);

  /// Triangulates all pieces that are not done, and writes their results. `isDone` has an entry for
  /// each piece. Returns false if `progress` stopped the run. Throws IOError.
  bool run(const std::vector<char>& isDone);

private:
  struct Cells;

  bool makePieces(const std::vector<char>& isDone, const PartitionOrder& order);
  void skipDone(const std::vector<char>& isDone, ReadyPartitions& ready);
  std::uint64_t takeMemory(PartitionIndex piece, const ReadyPartitions& ready);
  void make(PartitionIndex piece);
  std::vector<VertexMessage3> readInbox(PartitionIndex piece);
  PieceResult3 write(PartitionIndex piece, const Buffer<double>& rows, Cells& cells,
    const std::vector<Duplicate>& duplicates);
  void finish(PartitionIndex piece, std::uint64_t bytes, ReadyPartitions& ready);

  const PieceWork3 Work;
  const MemoryPlan3& Memory;
  const int Threads;
  const std::function<bool(std::int64_t)> Progress;
  const PartitionOrder* Order = nullptr;
  std::vector<VertexMessage3> Initial; ///< by piece: its message from the initial mesh

  std::mutex Mutex; ///< protects the members below
  std::condition_variable Changed;
  std::vector<std::unique_ptr<StoredResult3>> Results; ///< by piece; null: it is not done
  std::uint64_t LoadedBytes = 0;
  std::int64_t PointsDone = 0;
};

/// Completes the files of all pieces once all results exist: repairs the hull (Lemma 3), and adds
/// the borders to the interiors, unless an earlier process did so. Then only the global ids of
/// cells and of their neighbours are missing. `limit`: bytes of memory for the hull repair. Returns
/// the pieces in the order of the mesh; an empty list if `report` stopped the run. Throws IOError.
VTKTIPPFILTERS_EXPORT std::vector<FinishedPiece> finishPieces(const PieceWork3& work,
  std::uint64_t limit, int threads, const Report& report, PieceFigures& figures);

} // namespace tipp

#endif
