// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedTetrahedralization_h
#define tippDistributedTetrahedralization_h

#include "Arrays/Buffer.h"
#include "Distributed/DistributedStatistics.h"
#include "Distributed3D/Plan3.h"
#include "Predicates/Geometry.h"
#include "Ranks/Communicator.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Ghost cells. In triangles, the last corner is repeated.
using GhostTetrahedra = GhostCells<4, Point3>;

/// A rank's part of a triangulation in space. Corners are local indices (see DistributedPoints).
///
/// A cell is on the rank that owns its vertex of lowest internal id. Cells are in the order of
/// Tetrahedralization::Ids, but by local indices. So a part does not depend on threads and
/// partitions. Coplanar points have triangles instead of tetrahedra: those of
/// triangulateCoplanar().
struct DistributedTetrahedralization : DistributedPoints<Point3>
{
  /// Local indices, cellSize() of them per cell. orientation3() of a tetrahedron's corners is
  /// positive.
  Buffer<std::int32_t> Ids;
  int Dimension = -1; ///< of all ranks' points; see Tetrahedralization
  DistributedStatistics Statistics;

  /// Returns the number of corners of a cell.
  std::size_t cellSize() const { return this->Dimension == 2 ? 3 : 4; }
  std::size_t cellCount() const { return this->Ids.size() / this->cellSize(); }

  /// Calls visit(local index) for the corners of all cells.
  template <typename Visit>
  void forEachCorner(const Visit& visit) const
  {
    std::for_each(this->Ids.begin(), this->Ids.end(), visit);
  }
};

/// Returns this rank's part of the Delaunay triangulation of all ranks' points. Together, the ranks
/// have the tetrahedra that tetrahedralize() returns. Of coincident points on any ranks, the one
/// with the lowest global id represents the others. Collective. Throws RankFailure on all ranks if
/// any rank fails, or if its Progress stops the run.
VTKTIPPFILTERS_EXPORT DistributedTetrahedralization tetrahedralizeDistributed(
  Communicator& ranks, const RankPoints3& points, const TetrahedralizationOptions& options = {});

/// Returns one layer of ghost cells around this rank's cells. Collective. Throws RankFailure.
VTKTIPPFILTERS_EXPORT GhostTetrahedra fetchGhosts(
  Communicator& ranks, const DistributedTetrahedralization& mine);

/// Returns the neighbours of this rank's cells and ghosts; see neighborIdsOf(). Collective.
VTKTIPPFILTERS_EXPORT Buffer<std::int64_t> neighborIds(
  Communicator& ranks, const DistributedTetrahedralization& mine, const GhostTetrahedra& ghosts);

/// Moves all cells and points to the first rank; the others return an empty triangulation.
/// Collective.
VTKTIPPFILTERS_EXPORT DistributedTetrahedralization gatherOnFirst(
  Communicator& ranks, DistributedTetrahedralization mine, int threads);

/// Returns on the first rank the tetrahedra, duplicates and rejected points of all ranks, as
/// tetrahedralize() returns them for the points in the order of their global ids, which must be 0,
/// 1, 2 and so on. Other ranks return an empty triangulation. `triangles`: set for coplanar points,
/// as by triangulateCoplanar(). Collective.
VTKTIPPFILTERS_EXPORT Tetrahedralization gatherTetrahedra(Communicator& ranks,
  const DistributedTetrahedralization& mine, int threads, Triangulation& triangles);

} // namespace tipp

#endif
