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
  int Threads = 0;                                    ///< 0: OpenMP's choice
  /// The approximate number of points of a piece; 0: as memory allows.
  std::int64_t PiecePoints = 0;
  /// Adds the point array RepresentativePointId.
  bool MapDuplicates = false;
  /// Adds the cell array NeighborIds: for each corner of a tetrahedron the global id of the one
  /// across the opposite facet; -1 if there is none.
  bool Neighbors = false;
  /// A folder on another disk for temporary files except the pieces; empty: beside the mesh.
  std::string Scratch;
  /// Called now and then with the finished fraction, by one thread at a time; false ends the run.
  std::function<bool(double)> Progress;
};

struct OutOfCoreStatistics3 : PieceFigures
{
  std::int64_t Points = 0;
  std::int64_t Tetrahedra = 0;
  std::int64_t Rejected = 0;
  std::int64_t LeftOut = 0; ///< points that the options of the input have left out
  std::int64_t ThinnedOut = 0;
  std::int64_t Pieces = 0;
  std::uint64_t SpilledBytes = 0;
  std::uint64_t MeshBytes = 0;
  int Threads = 1;
  std::vector<OutOfCoreStatistics::Phase> Phases;
  bool Aborted = false; ///< by Progress
};

/// The Delaunay triangulation of points in space that need not fit in memory, as the partitioned
/// mesh `path`: the tetrahedra of tetrahedralize(). Ids are indices in the stream; a piece's cells
/// have consecutive ids; the files are the same for any number of threads. A column named z, Z or
/// elevation is the third coordinate; the others become arrays of points.
///
/// Points are read twice (once more if their coordinates are so far from 1 that they are scaled)
/// and spilled once, by piece; tetrahedra are written as soon as they are final. All is written to
/// a folder beside `path`, which is renamed to `path` when it is whole, and removed if the run
/// fails. Throws IOError, also for points in one plane.
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics3 tetrahedralizeOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions3& options = {});

} // namespace tipp

#endif
