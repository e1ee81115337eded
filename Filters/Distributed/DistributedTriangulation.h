// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedTriangulation_h
#define tippDistributedTriangulation_h

#include "Arrays/Buffer.h"
#include "Distributed/CellExchange.h"
#include "Distributed/DistributedStatistics.h"
#include "Distributed/Plan.h"
#include "Distributed/PointExchange.h"
#include "Ranks/Communicator.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Makes a Run on each rank, calls its run(), and returns the result that run() has set.
/// Collective. Throws RankFailure.
template <typename Run, typename Result, typename Points, typename Options>
Result runTogether(Communicator& ranks, const Points& points, const Options& options)
{
  Result result;
  ranks.together([&]() { Run(ranks, points, options, result).run(); });
  return result;
}

using PointTuples = PointTuplesOf<Point2>;
using IdTriangle = IdCell<3>;
using GhostTriangles = GhostCells<3, Point2>;

/// A rank's part of a triangulation. Corners are local indices (see DistributedPoints).
struct DistributedTriangulation : DistributedPoints<Point2>
{
  Buffer<std::int32_t> Ids32; ///< used if every index fits
  Buffer<std::int64_t> Ids64; ///< used otherwise; one of the two is empty
  DistributedStatistics Statistics;

  std::size_t triangleCount() const { return (this->Ids32.size() + this->Ids64.size()) / 3; }

  /// Calls visit(local index) for the corners of all triangles.
  template <typename Visit>
  void forEachCorner(const Visit& visit) const
  {
    std::for_each(this->Ids32.begin(), this->Ids32.end(), visit);
    std::for_each(this->Ids64.begin(), this->Ids64.end(), visit);
  }
};

/// Returns this rank's part of the Delaunay triangulation of all ranks' points: together the ranks
/// have the triangles that triangulate() returns. Of coincident points, on any ranks, the one with
/// the lowest global id represents all. Collective; throws RankFailure on all ranks if any rank
/// fails or its Progress stops the run.
VTKTIPPFILTERS_EXPORT DistributedTriangulation triangulateDistributed(
  Communicator& ranks, const RankPoints& points, const DistributedOptions& options = {});

/// Returns the ghosts of this rank's triangles. Collective.
VTKTIPPFILTERS_EXPORT GhostTriangles fetchGhosts(
  Communicator& ranks, const DistributedTriangulation& mine);

/// A rank's triangles by internal ids: indices among all ranks' owned points.
VTKTIPPFILTERS_EXPORT std::vector<IdTriangle> trianglesByIds(
  const DistributedTriangulation& mine, int rank);

/// Moves everything to the first rank; the others return an empty triangulation. Collective.
VTKTIPPFILTERS_EXPORT DistributedTriangulation gatherOnFirst(
  Communicator& ranks, DistributedTriangulation mine);

/// Returns all ranks' triangles, duplicates and rejected points, by global ids, on the first rank;
/// an empty triangulation on the others. Collective.
VTKTIPPFILTERS_EXPORT Triangulation gatherTriangles(
  Communicator& ranks, const DistributedTriangulation& mine);

} // namespace tipp

#endif
