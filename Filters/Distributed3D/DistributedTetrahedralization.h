// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedTetrahedralization_h
#define tippDistributedTetrahedralization_h

#include "Arrays/Buffer.h"
#include "Distributed/DistributedTriangulation.h"
#include "Distributed3D/PointExchange3.h"
#include "Ranks/Communicator.h"
#include "Triangulation3D/Tetrahedralize.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

using GhostTetrahedra = GhostCells<4, Point3>;

/// A rank's part of a triangulation in space. Corners are local indices: of Owned, the rank's own
/// points, and after them of Foreign, the other ranks' points that its tetrahedra use. An internal
/// id is a point's index among all ranks' owned points, rank by rank; a global id is the caller's.
///
/// A tetrahedron is on the rank that owns its vertex of lowest internal id. Tetrahedra are in the
/// order of Tetrahedralization, but by local indices. So a part is the same for any threads and
/// partitions.
struct DistributedTetrahedralization
{
  Buffer<std::int32_t> Ids; ///< four local indices each, so that orientation3() is positive
  PointTuples3 Owned;       ///< includes points without tetrahedra on this rank
  PointTuples3 Foreign;
  std::size_t RowSize = 0;
  std::vector<std::int64_t> ForeignIds; ///< internal ids of Foreign; ascending
  std::vector<std::int64_t> FirstIds;   ///< first internal id of each rank, and the end

  std::int64_t FirstCell = 0;        ///< index of this rank's first tetrahedron among all ranks'
  std::vector<Duplicate> Duplicates; ///< found on this rank; global ids
  std::vector<PointId> Rejected;     ///< of this rank's input; global ids
  int Dimension = -1;                ///< of all ranks' points: as of Tetrahedralization

  std::int64_t AllPoints = 0; ///< sum over all ranks
  std::int64_t AllCells = 0;
  std::int64_t AllDuplicates = 0;
  std::int64_t AllRejected = 0;
  DistributedStatistics Statistics;

  std::size_t cellCount() const { return this->Ids.size() / 4; }

  /// Calls visit(local index) for the corners of all tetrahedra.
  template <typename Visit>
  void forEachCorner(const Visit& visit) const
  {
    std::for_each(this->Ids.begin(), this->Ids.end(), visit);
  }
};

/// Returns this rank's part of the Delaunay triangulation of all ranks' points: together the ranks
/// have the tetrahedra that tetrahedralize() returns. Of coincident points, on any ranks, the one
/// with the lowest global id represents all. Collective; throws RankFailure on all ranks if any
/// rank fails or its Progress stops the run.
VTKTIPPFILTERS_EXPORT DistributedTetrahedralization tetrahedralizeDistributed(
  Communicator& ranks, const RankPoints3& points, const TetrahedralizationOptions& options = {});

/// Returns one layer of ghosts of this rank's tetrahedra. Collective.
VTKTIPPFILTERS_EXPORT GhostTetrahedra fetchGhosts(
  Communicator& ranks, const DistributedTetrahedralization& mine);

/// Moves everything to the first rank; the others return an empty triangulation. Collective.
VTKTIPPFILTERS_EXPORT DistributedTetrahedralization gatherOnFirst(
  Communicator& ranks, DistributedTetrahedralization mine, int threads);

/// Returns all ranks' tetrahedra, duplicates and rejected points on the first rank, as
/// tetrahedralize() does for points in the order of global ids, which must be 0, 1, ...; an empty
/// triangulation on the others. Collective.
VTKTIPPFILTERS_EXPORT Tetrahedralization gatherTetrahedra(
  Communicator& ranks, const DistributedTetrahedralization& mine, int threads);

} // namespace tipp

#endif
