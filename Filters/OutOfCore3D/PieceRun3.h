// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceRun3_h
#define tippPieceRun3_h

#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/PieceResult.h"
#include "OutOfCore/ScratchFiles.h"
#include "OutOfCore3D/PiecePlan3.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioned/PartitionedMesh.h"
#include "Triangulation3D/Dataflow3.h"
#include "vtkTIPPFiltersModule.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tipp
{

class ReadyPartitions;

/// The input and the destination of the work on a run's pieces. References are not owned.
struct PieceWork3
{
  const PiecePlan3& Plan;
  const PointRowLayout& Rows;
  const PartitionedMesh& Mesh;
  std::string Results; ///< prefix of the paths of results

  std::string resultPath(PartitionIndex piece) const
  {
    return this->Results + "." + std::to_string(this->Plan.number(piece));
  }
  std::string finishedPath(PartitionIndex piece) const
  {
    return this->resultPath(piece) + ".finished";
  }
};

using BorderCells3 = BorderCells<4>;
using BordersByOwner3 = std::map<PartitionIndex, BorderCells3>;

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

/// The result of a piece that is done: the data that others need, besides the interior's part of
/// the mesh file. See PieceResult, which does the same in the plane. It is written once and never
/// changed; the set of these files is the state from which a run is resumed.
struct PieceResult3
{
  PieceInterior Interior;
  PieceFigures Figures;
  std::vector<Vertex3> HullVertices; ///< true corners of tetrahedra with artificial corners
  BordersByOwner3 Borders;
  SentMessages3 Sent;
};

/// Writes a result to a file. Throws IOError.
VTKTIPPFILTERS_EXPORT void writeResult(const std::string& path, const PieceResult3& result);

/// Reads parts of a result from its file. Methods throw IOError if it is damaged or missing.
class VTKTIPPFILTERS_EXPORT StoredResult3
{
public:
  explicit StoredResult3(const std::string& path)
    : File(path)
  {
  }

  /// Returns the approximate number of vertices sent to the piece `to`; 0: none.
  std::int64_t countSent(PartitionIndex to) const;
  /// `to`: the piece that receives the message.
  VertexMessage3 readMessage(PartitionIndex to) const;
  /// `owner`: the piece that owns the tetrahedra.
  bool hasBorder(PartitionIndex owner) const;
  BorderCells3 readBorder(PartitionIndex owner) const;
  std::vector<Vertex3> readHullVertices() const;
  PieceFigures readFigures() const;
  /// Reads the interface points and their rows. `all`: also the rest of the interior.
  PieceInterior readInterior(const PieceWork3& work, PartitionIndex piece, bool all) const;

private:
  SectionFile File;
};

using StoredResults3 = std::vector<std::unique_ptr<StoredResult3>>;

/// Returns for each piece whether an earlier process left its files undamaged; see verifyPieces().
VTKTIPPFILTERS_EXPORT std::vector<char> verifyResults(const PieceWork3& work, int threads,
  const Report& report, const std::function<void(const std::string&)>& warn);

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

  /// Triangulates all pieces that are not done (`isDone` has an entry for each piece), and sets the
  /// results of all. Returns false if `progress` stopped the run. Throws IOError.
  bool run(const std::vector<char>& isDone, StoredResults3& results);

private:
  struct Cells;

  void makePieces(const std::vector<char>& isDone, const PartitionOrder& order);
  void skipDone(const std::vector<char>& isDone, ReadyPartitions& ready);
  std::uint64_t takeMemory(PartitionIndex piece);
  void make(PartitionIndex piece);
  std::vector<VertexMessage3> readInbox(PartitionIndex piece);
  PieceResult3 write(PartitionIndex piece, const Buffer<double>& rows, Cells& cells,
    const std::vector<Duplicate>& duplicates);
  bool finish(PartitionIndex piece);

  const PieceWork3 Work;
  const MemoryPlan3& Memory;
  const int Threads;
  const std::function<bool(std::int64_t)> Progress;
  const PartitionOrder* Order = nullptr;
  StoredResults3* Results = nullptr;
  std::vector<VertexMessage3> Initial; ///< by piece: its message from the initial mesh

  std::mutex Mutex; ///< protects the members below and Results
  std::condition_variable Changed;
  std::uint64_t LoadedBytes = 0;
  std::int64_t PointsDone = 0;
  bool IsStopped = false;
};

/// Completes the files of all pieces once all results exist: repairs the hull (Lemma 3), and adds
/// the borders to the interiors, unless an earlier process did so. Then only the global ids of
/// cells and of their neighbours are missing. `limit`: bytes of memory for the hull repair. Returns
/// the pieces in the order of the mesh; an empty list if `report` stopped the run. Throws IOError.
VTKTIPPFILTERS_EXPORT std::vector<FinishedPiece> finishPieces(const PieceWork3& work,
  const StoredResults3& results, std::uint64_t limit, int threads, const Report& report,
  PieceFigures& figures);

} // namespace tipp

#endif
