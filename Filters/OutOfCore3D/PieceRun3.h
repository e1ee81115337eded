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

/// What a run's pieces are made of and go to.
struct PieceWork3
{
  const PiecePlan3& Plan;
  const PointRowLayout& Rows;
  const PartitionedMesh& Mesh;
  std::string Results; ///< how the paths of pieces' results begin

  std::string resultPath(PartitionIndex piece) const
  {
    return this->Results + "." + std::to_string(this->Plan.number(piece));
  }
};

using BorderCells3 = BorderCells<4>;
using BordersByOwner3 = std::map<PartitionIndex, BorderCells3>;

/// Adds a tetrahedron to those of the piece that owns it: of all that the tetrahedron meets, the
/// first in the mesh. The others borrow it.
class VTKTIPPFILTERS_EXPORT BorderSorter3
{
public:
  explicit BorderSorter3(const PiecePlan3& plan)
    : Plan(plan)
  {
  }

  /// The numbers of the pieces in the mesh that the tetrahedron meets, ascending; valid until the
  /// next call.
  const std::vector<std::int32_t>& findMet(const std::array<Vertex3, 4>& corners);
  /// Adds it to the borders; `met`: of findMet().
  void add(const std::array<Vertex3, 4>& corners, const std::vector<std::int32_t>& met,
    BordersByOwner3& borders) const;

private:
  const PiecePlan3& Plan;
  std::vector<std::int32_t> Met;
};

/// What a piece that is done leaves for others, besides the interior's share of its file in the
/// mesh; see PieceResult, which is the same in the plane.
struct PieceResult3
{
  PieceInterior Interior;
  PieceFigures Figures;
  std::vector<Vertex3> HullVertices; ///< of tetrahedra at artificial points
  BordersByOwner3 Borders;
  SentMessages3 Sent;
};

/// Throws IOError.
VTKTIPPFILTERS_EXPORT void writeResult(const std::string& path, const PieceResult3& result);

/// A result on disk, read by parts. Throws IOError for what is damaged or missing.
class VTKTIPPFILTERS_EXPORT StoredResult3
{
public:
  explicit StoredResult3(const std::string& path)
    : File(path)
  {
  }

  /// About how many vertices a piece is sent; 0: none.
  std::int64_t countSent(PartitionIndex to) const;
  VertexMessage3 readMessage(PartitionIndex to) const;
  bool hasBorder(PartitionIndex owner) const;
  BorderCells3 readBorder(PartitionIndex owner) const;
  std::vector<Vertex3> readHullVertices() const;
  PieceFigures readFigures() const;
  /// Points on the interface, and their rows; `all`: the rest of the interior too.
  PieceInterior readInterior(const PieceWork3& work, PartitionIndex piece, bool all) const;

private:
  SectionFile File;
};

using StoredResults3 = std::vector<std::unique_ptr<StoredResult3>>;

/// Loads pieces, triangulates them by threads, as many at a time as there is memory for, and writes
/// what comes of each.
class VTKTIPPFILTERS_EXPORT PieceRun3
{
public:
  /// `progress` is told how many points are done, by one thread at a time; false ends the run.
  PieceRun3(const PieceWork3& work, const MemoryPlan3& memory, int threads,
    std::function<bool(std::int64_t)> progress);

  /// Sets the results of all pieces. Returns false if progress ended it. Throws IOError.
  bool run(StoredResults3& results);

private:
  struct Cells;

  void makePieces(StoredResults3& results, const PartitionOrder& order);
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
  std::vector<VertexMessage3> Initial; ///< from the initial mesh, to each piece

  std::mutex Mutex; ///< for what follows and Results
  std::condition_variable Changed;
  std::uint64_t LoadedBytes = 0;
  std::int64_t PointsDone = 0;
  bool IsStopped = false;
};

/// Completes the files of all pieces when all results are there: repairs the hull (Lemma 3) and
/// adds the borders to the interiors. A piece's file is complete then, except for the global ids of
/// cells. Returns the pieces by their numbers in the mesh; an empty list if `report` ended it.
/// `limit`: bytes that the hull repair may take. Throws IOError.
VTKTIPPFILTERS_EXPORT std::vector<FinishedPiece> finishPieces(const PieceWork3& work,
  const StoredResults3& results, std::uint64_t limit, int threads, const Report& report,
  PieceFigures& figures);

} // namespace tipp

#endif
