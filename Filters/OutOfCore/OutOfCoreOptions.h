// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreOptions_h
#define tippOutOfCoreOptions_h

#include "Constraints/ResolveCrossings.h"
#include "Triangulation/ResolveDuplicates.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

class PointStream;
class TriangleConsumer;

/// Opens the input, on each rank.
using OpenPoints = std::function<std::unique_ptr<PointStream>()>;

/// Options of runs out of core in the plane and in space.
struct OutOfCoreRunOptions
{
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30; ///< in bytes
  int Threads = 0;                                    ///< 0: defaultThreads()
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

} // namespace tipp

#endif
