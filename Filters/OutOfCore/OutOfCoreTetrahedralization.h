// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTetrahedralization_h
#define tippOutOfCoreTetrahedralization_h

#include "OutOfCore/OutOfCoreOptions.h"
#include "Points/ReadPoints.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <string>

namespace tipp
{

using OutOfCoreOptions3 = OutOfCoreRunOptions;

struct OutOfCoreStatistics3 : OutOfCoreRunStatistics
{
  std::int64_t Tetrahedra = 0;
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

/// Runs tetrahedralizeOutOfCore() on all ranks, as triangulateOutOfCoreOnRanks() does in the plane.
VTKTIPPFILTERS_EXPORT OutOfCoreStatistics3 tetrahedralizeOutOfCoreOnRanks(Communicator& ranks,
  const OpenPoints& open, const std::string& path, const OutOfCoreOptions3& options);

} // namespace tipp

#endif
