// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTriangulation_h
#define tippOutOfCoreTriangulation_h

#include "Constraints/ConstraintSegments.h"
#include "Duplicates/ResolveDuplicates.h"
#include "Partitioned/PieceBorder.h"
#include "Points/PointStream.h"
#include "Predicates/Points.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Receives the final triangles of a triangulation out of core, instead of a mesh on disk. What it
/// keeps must survive the process if the run is to be resumed.
class TriangleConsumer
{
public:
  virtual ~TriangleConsumer() = default;

  /// Equal for takers that do the same in another run.
  virtual std::string identity() const = 0;

  /// About how many bytes of disk it needs where its files are.
  virtual std::uint64_t fileBytes(
    const Box2& bounds, const std::vector<std::string>& columns) const = 0;

  /// Before the first triangles, when the points are known; on all ranks. `files`: how the paths of
  /// files begin that stay until the end of the run; all ranks see them.
  virtual void begin(
    const Box2& bounds, const std::vector<std::string>& columns, const std::string& files) = 0;

  /// Triangles of points in rows; each of the whole triangulation once, or again in a resumed run.
  /// `name`: of this part; the same when it is made again. Called by several threads at once.
  virtual void take(const std::string& name, const double* rows, const PointRowLayout& layout,
    std::size_t points, const std::vector<TriangleRange>& triangles) = 0;

  /// When all are taken; on the first rank. False if `progress` ended it.
  virtual bool end(const std::function<bool(double)>& progress) = 0;
};

class Communicator;
class TriangleConsumer;

struct OutOfCoreOptions
{
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30; ///< in bytes
  int Threads = 0;                                    ///< 0: OpenMP's choice
  int Columns = 0; ///< with Rows, a grid of pieces; 0: boxes of equally many points
  int Rows = 0;
  std::int64_t PiecePoints = 0;     ///< approximate points of a piece; 0: as memory allows
  std::int64_t PartitionPoints = 0; ///< approximate points of a partition; 0: chosen
  double MaximumEdge = 0;           ///< triangles with a longer edge are left out; 0: none are
  /// Which values a position with several points gets.
  DuplicateRule Duplicates = DuplicateRule::First;
  /// Adds the point array RepresentativePointId.
  bool MapDuplicates = false;
  /// Adds the cell array NeighborIds.
  bool Neighbors = false;
  /// Adds the cell array ConstraintEdges: for each corner of a triangle 1 if the edge opposite to
  /// it is one of a constraint, else 0.
  bool MarkConstraints = false;
  /// Counts and sums up the triangles instead of writing them.
  bool CountOnly = false;
  /// Takes the triangles instead of the mesh; with it CountOnly is to be set.
  TriangleConsumer* Consumer = nullptr;
  /// Called before the first pass over the points, unless the run is resumed: segments between
  /// points of the stream that have to be edges. Null: there are none. They are written to a file,
  /// and read by piece; those that cut stay in memory.
  std::function<SegmentSource&()> Constraints;
  /// Resumes a run of this path that was killed or has failed, if there is one; without, such a run
  /// is an error and is left as it is.
  bool Resume = false;
  /// A folder on another disk for temporary files except the pieces; empty: beside the mesh.
  std::string Scratch;
  /// Called regularly with the finished fraction, in the calling thread; false ends the run.
  std::function<bool(double)> Progress;
  /// Called with a sentence about damaged results of an earlier run, which are made again.
  std::function<void(const std::string&)> Warn;
};

/// Statistics of a piece, or of all pieces.
struct PieceFigures
{
  std::int64_t Duplicates = 0;
  std::int64_t DisagreeingPositions = 0; ///< positions whose points differ in elevation
  std::int64_t WorkerVertices = 0;       ///< that workers triangulated
  std::uint64_t BoundaryBytes = 0; ///< of vertices that were sent to partitions of other pieces

  void add(const PieceFigures& other)
  {
    this->Duplicates += other.Duplicates;
    this->DisagreeingPositions += other.DisagreeingPositions;
    this->WorkerVertices += other.WorkerVertices;
    this->BoundaryBytes += other.BoundaryBytes;
  }
};

struct OutOfCoreStatistics : PieceFigures
{
  struct Phase
  {
    std::string Name;
    double Seconds;
  };
  std::int64_t Points = 0;
  std::int64_t Triangles = 0;
  std::uint64_t TriangleSum = 0; ///< where they are only counted: of hashTriangle()
  std::int64_t Rejected = 0;
  std::int64_t WithoutElevation = 0; ///< points whose elevation is NaN or infinite
  std::int64_t LeftOut = 0;          ///< points that the options of the input have left out
  std::int64_t ThinnedOut = 0;
  std::int64_t Pieces = 0;
  std::int64_t Partitions = 0;
  std::uint64_t SpilledBytes = 0;
  std::uint64_t MeshBytes = 0;
  int Threads = 1;
  std::vector<Phase> Phases;
  bool Resumed = false;
  bool Aborted = false; ///< by Progress
  bool Kept = false;    ///< then the run can be resumed
};

/// The Delaunay triangulation of points that need not fit in memory, as the partitioned mesh
/// `path`: the triangles of triangulate(). Ids are indices in the stream; a piece's cells have
/// consecutive ids; the files are the same for any number of threads. A column named z is the third
/// coordinate; the others become arrays of points.
///
/// Points are read twice (once more if their coordinates are so far from 1 that they are scaled)
/// and spilled once, by piece; triangles are written as soon as they are final. All is written to a
/// folder ".NAME.part" beside `path`, which is renamed to `path` when it is whole. Once the points
/// are spilled the folder is kept if the run fails or is stopped; another run can resume it and
/// makes the same files. Throws IOError.
///
/// Ranks: others that work with this first one, see triangulateOutOfCoreOnRanks(); null: none.
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics triangulateOutOfCore(PointStream& points,
  const std::string& path, const OutOfCoreOptions& options = {}, Communicator* ranks = nullptr);

constexpr MessageKind pieceMessage(std::uint32_t n)
{
  return static_cast<MessageKind>(static_cast<std::uint32_t>(MessageKind::FirstFree) + n);
}

/// @name From the first rank
///@{
constexpr MessageKind SurveyMessage = pieceMessage(0); ///< these three for an InputHelper
constexpr MessageKind FactorMessage = pieceMessage(1);
constexpr MessageKind SpillMessage = pieceMessage(2);
constexpr MessageKind SetUpMessage = pieceMessage(3); ///< what was prepared
constexpr MessageKind EndMessage = pieceMessage(4);   ///< there is no more work
///@}
/// To the first rank: of the input.
constexpr MessageKind PartMessage = pieceMessage(5);
/// @name Between any ranks
///@{
constexpr MessageKind PartitionMessage = pieceMessage(6); ///< it is done; what it sends
constexpr MessageKind PieceMessage = pieceMessage(7);     ///< its result is on disk
///@}

class RunSetup;

using OpenPoints = std::function<std::unique_ptr<PointStream>()>;

/// triangulateOutOfCore() on all ranks, each of which calls this with the same path and options:
/// points are surveyed and spilled, pieces loaded and triangulated and their interiors written by
/// all; the first one makes the plan and completes the pieces at the end. The files are those of
/// one process. `open` is called on all ranks; where it throws an IOError or opens another input
/// than on the first rank, that one reads this rank's part. The figures are on the first rank.
///
/// All ranks must see the folders. The memory limit and the threads are those of each rank. Throws
/// RankFailure on all ranks; the statistics of a run that was ended by Progress on any rank have
/// Aborted on all. Not to be called within Communicator::together().
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics triangulateOutOfCoreOnRanks(Communicator& ranks,
  const OpenPoints& open, const std::string& path, const OutOfCoreOptions& options);

/// Whether all ranks see a folder of the first rank, by a file that is there for a moment;
/// collective. Throws IOError on a rank that does not.
VTKTIPPFILTERS_EXPORT void requireSharedFolder(Communicator& ranks, const std::string& folder);

/// Of the first rank: sends the others, which wait for it in triangulateOutOfCoreOnRanks(), what
/// they need to work on pieces. `points`: the file they are spilled to; `isDone`: of each piece,
/// whether it is done already.
VTKTIPPFILTERS_EXPORT void shareSetup(Communicator& ranks, RunSetup& prepared,
  const std::string& points, const std::vector<char>& isDone);

} // namespace tipp

#endif
