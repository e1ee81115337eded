// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTriangulation_h
#define tippOutOfCoreTriangulation_h

#include "OutOfCore/OutOfCoreOptions.h"
#include "Points/ReadPoints.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPFiltersModule.h"

#include <string>

namespace tipp
{

/// Computes the Delaunay triangulation of points that need not fit in memory, and writes it to the
/// partitioned mesh `path`. The triangles are those of triangulate(). Global point ids are indices
/// in the stream; the cells of a piece have consecutive global ids. The files are the same for any
/// number of threads. A column named z is the third coordinate; other columns become point arrays.
///
/// If `points` is a ConstrainedStream, its segments become edges; their ends are points of the
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

} // namespace tipp

#endif
