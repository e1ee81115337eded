// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTetrahedralization_h
#define tippOutOfCoreTetrahedralization_h

#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Points/PointStream.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// Options of tetrahedralizeOutOfCore().
struct OutOfCoreOptions3
{
  std::uint64_t MemoryLimit = std::uint64_t(2) << 30; ///< in bytes
  int Threads = 0;                                    ///< 0: OpenMP's default
  /// The approximate number of points per piece; 0: as memory allows.
  std::int64_t PiecePoints = 0;
  /// Adds the point array RepresentativePointId.
  bool MapDuplicates = false;
  /// Adds the cell array NeighborIds: for each corner of a tetrahedron the global id of the
  /// tetrahedron opposite to it, -1 at the hull.
  bool Neighbors = false;
  /// Resumes an interrupted run of the same path, if there is one. If false, such a run is an
  /// error, and its files are left unchanged.
  bool Resume = false;
  /// A folder for temporary files on another disk, except the pieces. Empty: beside the mesh.
  std::string Scratch;
  /// Called regularly with the finished fraction (0 to 1), by one thread at a time. Returns false
  /// to stop the run.
  std::function<bool(double)> Progress;
  /// Called with a sentence about damaged results of an earlier run, which are then made again.
  std::function<void(const std::string&)> Warn;
};

/// Statistics of a run out of core in space.
struct OutOfCoreStatistics3 : PieceFigures
{
  std::int64_t Points = 0;
  std::int64_t Tetrahedra = 0;
  std::int64_t Rejected = 0;
  std::int64_t LeftOut = 0;    ///< points that the input's options exclude
  std::int64_t ThinnedOut = 0; ///< points that thinning removed
  std::int64_t Pieces = 0;
  std::uint64_t SpilledBytes = 0;
  std::uint64_t MeshBytes = 0;
  int Threads = 1;
  std::vector<OutOfCoreStatistics::Phase> Phases;
  bool Resumed = false;
  bool Aborted = false; ///< Progress stopped the run
  bool Kept = false;    ///< if aborted: the run can be resumed
};

/// Computes the Delaunay triangulation of points in space that need not fit in memory, and writes
/// it to the partitioned mesh `path`. The tetrahedra are those of tetrahedralize(). Global point
/// ids are indices in the stream; the cells of a piece have consecutive global ids. The files are
/// the same for any number of threads. A column named z, Z or elevation is the third coordinate;
/// other columns become point arrays.
///
/// Points are read twice (three times if coordinates are so far from 1 that they are scaled) and
/// spilled once, sorted by piece. Tetrahedra are written as soon as they are final. All files are
/// in a folder ".NAME.part" beside `path`, which is renamed to `path` when the mesh is complete.
/// Once the points are spilled, the folder is kept if the run fails or is stopped. Another run can
/// resume it, even with another number of threads or memory limit, and makes the same files. Throws
/// IOError, also if all points are in one plane.
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics3 tetrahedralizeOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions3& options = {});

} // namespace tipp

#endif
