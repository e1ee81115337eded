// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTriangulation_h
#define tippOutOfCoreTriangulation_h

#include "Constraints/ConstraintPieces.h"
#include "Partitioned/GrowingPiece.h"
#include "Points/ReadPoints.h"
#include "Predicates/Points.h"
#include "Ranks/Communicator.h"
#include "Triangulation/ResolveDuplicates.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Receives the final triangles of a triangulation out of core instead of a mesh on disk. To resume
/// a run in another process, the consumer must keep its state in files.
class TriangleConsumer
{
public:
  virtual ~TriangleConsumer() = default;

  /// Returns a text that is equal for consumers that do the same, so that a run is resumed with the
  /// same consumer.
  virtual std::string identity() const = 0;

  /// Returns the approximate number of bytes that the consumer needs on the disk of its files.
  virtual std::uint64_t fileBytes(
    const Box2& bounds, const std::vector<std::string>& columns) const = 0;

  /// Called once, on all ranks, when the points are known and before the first triangles. `files`:
  /// prefix for paths of files that stay until the end of the run; all ranks see them. `bounds`: of
  /// the finite points, without those of constraints. `columns`: of the input, beside x and y.
  virtual void begin(
    const Box2& bounds, const std::vector<std::string>& columns, const std::string& files) = 0;

  /// Receives triangles as corners that are indices into `points` rows. The calls together pass
  /// each triangle of the triangulation once, or again if the run is resumed. `name` identifies
  /// this part of the triangles: it is the same when the part is passed again. Called by several
  /// threads at the same time.
  virtual void take(const std::string& name, const double* rows, const PointRowLayout& layout,
    std::size_t points, const std::vector<TriangleRange>& triangles) = 0;

  /// Called on the first rank when all triangles have been passed. Returns false if `progress`
  /// stopped it.
  virtual bool end(const std::function<bool(double)>& progress) = 0;
};

/// Options of runs out of core in the plane and in space.
struct OutOfCoreRunOptions
{
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30; ///< in bytes
  int Threads = 0;                                    ///< 0: OpenMP's default
  std::int64_t PiecePoints = 0; ///< approximate points per piece; 0: as memory allows
  /// Adds the point array RepresentativePointId.
  bool MapDuplicates = false;
  /// Adds the cell array NeighborIds: for each corner of a cell the global id of the cell opposite
  /// to it, -1 at the border.
  bool Neighbors = false;
  /// Resumes an interrupted run of the same path, if there is one. If false, such a run is an
  /// error, and its files are left unchanged.
  bool Resume = false;
  /// A folder for temporary files on another disk, except the pieces. Empty: beside the mesh.
  std::string Scratch;
  /// Called regularly with the finished fraction (0 to 1), by one thread at a time; in the plane in
  /// the calling thread. Returns false to stop the run.
  std::function<bool(double)> Progress;
  /// Called with a sentence about damaged results of an earlier run, which are then made again.
  std::function<void(const std::string&)> Warn;
};

/// Options of triangulateOutOfCore().
struct OutOfCoreOptions : OutOfCoreRunOptions
{
  int Columns = 0; ///< with Rows: pieces form a grid; 0: boxes of equally many points
  int Rows = 0;
  std::int64_t PartitionPoints = 0; ///< approximate points per partition; 0: chosen automatically
  double MaximumEdge = 0;           ///< triangles with a longer edge are left out; 0: all are kept
  /// How the values are chosen for a position that several points have.
  DuplicateRule Duplicates = DuplicateRule::First;
  /// Adds the cell array ConstraintEdges: three values per triangle, 1 if the edge opposite to the
  /// corner is part of a constraint, else 0.
  bool MarkConstraints = false;
  /// Computes the number and a checksum of the triangles instead of writing them.
  bool CountOnly = false;
  /// Receives the triangles instead of a mesh on disk; requires CountOnly. Not owned. Null: no
  /// consumer.
  TriangleConsumer* Consumer = nullptr;
};

/// Statistics of a piece, or of all pieces.
struct PieceFigures
{
  std::int64_t Duplicates = 0;
  std::int64_t DisagreeingPositions = 0; ///< positions whose points have different elevations
  std::int64_t WorkerVertices = 0;       ///< vertices triangulated by workers
  std::uint64_t BoundaryBytes = 0;       ///< of vertices sent to partitions of other pieces

  void add(const PieceFigures& other)
  {
    this->Duplicates += other.Duplicates;
    this->DisagreeingPositions += other.DisagreeingPositions;
    this->WorkerVertices += other.WorkerVertices;
    this->BoundaryBytes += other.BoundaryBytes;
  }
};

/// Statistics of a run out of core in the plane or in space.
struct OutOfCoreRunStatistics : PieceFigures
{
  struct Phase
  {
    std::string Name;
    double Seconds;
  };
  std::int64_t Points = 0;
  std::int64_t Rejected = 0;
  std::int64_t LeftOut = 0;    ///< points that the input's options exclude
  std::int64_t ThinnedOut = 0; ///< points that thinning removed
  std::int64_t Pieces = 0;
  std::uint64_t SpilledBytes = 0;
  std::uint64_t MeshBytes = 0;
  int Threads = 1;
  std::vector<Phase> Phases;
  bool Resumed = false;
  bool Aborted = false; ///< Progress stopped the run
  bool Kept = false;    ///< if aborted: the run can be resumed
};

struct OutOfCoreStatistics : OutOfCoreRunStatistics
{
  std::int64_t Triangles = 0;
  std::uint64_t TriangleSum = 0;     ///< if they are only counted: the sum of hashTriangle()
  std::int64_t WithoutElevation = 0; ///< points whose elevation is NaN or infinite
  std::int64_t Partitions = 0;
  ConstraintFigures Constraints; ///< all 0 without constraints, and if the run is resumed
};

/// Computes the Delaunay triangulation of points that need not fit in memory, and writes it to the
/// partitioned mesh `path`. The triangles are those of triangulate(). Global point ids are indices
/// in the stream; the cells of a piece have consecutive global ids. The files are the same for any
/// number of threads. A column named z is the third coordinate; other columns become point arrays.
///
/// If `points` is also a SegmentSource, its segments become edges; their ends are points of the
/// stream. They are written to a file and read piece by piece, except for those that decide which
/// triangles are kept: these stay in memory.
///
/// Points are read twice (once more if coordinates are so far from 1 that they are scaled, and once
/// more if segments of the stream's constraints cross) and spilled once, sorted by piece. Triangles
/// are written as soon as they are final. All files are in a folder ".NAME.part" beside `path`,
/// which is renamed to `path` when the mesh is complete. Once the points are spilled, the folder is
/// kept if the run fails or is stopped; another run can resume it and makes the same files. Throws
/// IOError.
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics triangulateOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions& options = {});

/// @name From the first rank; the kinds before these are those of RankEngine
///@{
/// Handled by helpWithInput(), like the next two.
constexpr MessageKind SurveyMessage = kindAfter(2);
constexpr MessageKind FactorMessage = kindAfter(3);
constexpr MessageKind SpillMessage = kindAfter(4);
constexpr MessageKind SetUpMessage = kindAfter(5); ///< RunSetup, and which pieces are done
constexpr MessageKind EndMessage = kindAfter(6);   ///< there is no more work
///@}
/// An answer of helpWithInput() to the first rank.
constexpr MessageKind PartMessage = kindAfter(7);
/// Between any ranks: the piece is done, and its result is on disk.
constexpr MessageKind PieceMessage = kindAfter(8);

using OpenPoints = std::function<std::unique_ptr<PointStream>()>;

/// Runs triangulateOutOfCore() on all ranks. All must call this with the same path and options. All
/// ranks survey and spill points, triangulate pieces and write their interiors. The first rank
/// makes the plan, and completes the pieces at the end. The files are those of a single process.
/// `open` is called on all ranks. If it throws an IOError on a rank, or opens another input there
/// than on the first rank, the first rank reads that rank's part. Only the first rank returns
/// statistics.
///
/// All ranks must see the same folders. The memory limit and the number of threads apply to each
/// rank. Throws RankFailure on all ranks. If Progress stops the run on any rank, Aborted is set on
/// all. Must not be called within Communicator::together().
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics triangulateOutOfCoreOnRanks(Communicator& ranks,
  const OpenPoints& open, const std::string& path, const OutOfCoreOptions& options);

/// Checks that all ranks see a folder of the first rank, by means of a temporary file. Collective.
/// Throws IOError on each rank that does not see it. Only the first rank's `folder` is used.
VTKTIPPFILTERS_EXPORT void requireSharedFolder(Communicator& ranks, const std::string& folder);

} // namespace tipp

#endif
