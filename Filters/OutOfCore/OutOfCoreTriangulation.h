// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTriangulation_h
#define tippOutOfCoreTriangulation_h

#include "Duplicates/ResolveDuplicates.h"
#include "OutOfCore/PieceFigures.h"
#include "Points/PointStream.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

class Communicator;
class TriangleTaker;

struct OutOfCoreOptions
{
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30; ///< in bytes
  int Threads = 0;                                    ///< 0: OpenMP's choice
  int Columns = 0; ///< with Rows, a grid of pieces; 0: boxes of equally many points
  int Rows = 0;
  std::int64_t PiecePoints = 0;     ///< about so many points a piece; 0: as memory allows
  std::int64_t PartitionPoints = 0; ///< about so many points for a worker at once; 0: chosen
  double MaximumEdge = 0;           ///< triangles with a longer edge are left out; 0: none are
  /// Which values a place of several points has.
  DuplicateRule Duplicates = DuplicateRule::First;
  /// Adds the point array RepresentativePointId.
  bool MapDuplicates = false;
  /// Adds the cell array NeighborIds.
  bool Neighbors = false;
  /// Counts and sums up the triangles instead of writing them.
  bool CountOnly = false;
  /// Takes the triangles instead of the mesh; with it CountOnly is to be set.
  TriangleTaker* Taker = nullptr;
  /// Goes on where a run that was killed or failed has been, if there is one for this path; else
  /// such a run is not touched and is an error.
  bool Resume = false;
  /// A folder on another disk for what is temporary, but for the pieces; empty: beside the mesh.
  std::string Scratch;
  /// Told the finished fraction now and then, in the thread that called; false ends the run.
  std::function<bool(double)> Progress;
  /// Told in one sentence what of an earlier run is damaged and therefore made again.
  std::function<void(const std::string&)> Warn;
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
  std::uint64_t TriangleSum = 0; ///< where they are only counted: of GrowingPiece::hashTriangle()
  std::int64_t Rejected = 0;
  std::int64_t LeftOut = 0; ///< points that the options of the input have left out
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
/// `path`: the triangles of triangulate(), ids being places in the stream, the files the same for
/// every number of threads. A piece's cells have successive ids. A column named z is the third
/// coordinate; the others become arrays of points.
///
/// Points are read twice (once more if their coordinates are so far from 1 that they are scaled)
/// and spilled once, by piece; triangles are written as soon as they are final. All is written to a
/// folder ".NAME.part" beside `path`, which takes the path's place when it is whole. From the time
/// the points are spilled it stays if the run fails, is ended or killed, and another can go on:
/// with the same files at the end. Throws IOError.
///
/// Ranks: others that work with this first one, see triangulateOutOfCoreOnRanks(); null: none.
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics triangulateOutOfCore(PointStream& points,
  const std::string& path, const OutOfCoreOptions& options = {}, Communicator* ranks = nullptr);

} // namespace tipp

#endif
