// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedTriangulation_h
#define tippDistributedTriangulation_h

#include "Arrays/Buffer.h"
#include "Distributed/DistributedOptions.h"
#include "Distributed/DistributedStatistics.h"
#include "Distributed/PointExchange.h"
#include "Ranks/Communicator.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Points with their global ids and data; the arrays have the same order.
struct PointTuples
{
  Buffer<Point2> Places;
  Buffer<PointId> GlobalIds;
  Buffer<char> Rows; ///< as RankPoints::PackRow wrote them
  std::size_t size() const { return this->Places.size(); }
};

/// A rank's part of a triangulation. Corners are local indices: of Owned, the rank's own points,
/// and after them of Foreign, the other ranks' points that its triangles use. An internal id is a
/// point's index among all ranks' owned points, rank by rank; a global id is the caller's.
struct DistributedTriangulation
{
  Buffer<std::int32_t> Ids32; ///< used if every index fits
  Buffer<std::int64_t> Ids64;
  PointTuples Owned; ///< includes points without triangles on this rank
  PointTuples Foreign;
  std::size_t RowSize = 0;
  std::vector<std::int64_t> ForeignIds; ///< internal ids of Foreign; ascending
  std::vector<std::int64_t> FirstIds;   ///< first internal id of each rank, and the end

  std::int64_t FirstTriangle = 0;    ///< index of this rank's first triangle among all ranks'
  std::vector<Duplicate> Duplicates; ///< found on this rank; global ids
  std::vector<PointId> Rejected;     ///< of this rank's input; global ids

  std::int64_t AllPoints = 0; ///< sum over all ranks
  std::int64_t AllTriangles = 0;
  std::int64_t AllDuplicates = 0;
  std::int64_t AllRejected = 0;
  DistributedStatistics Statistics;

  std::size_t triangleCount() const { return (this->Ids32.size() + this->Ids64.size()) / 3; }
};

/// Returns this rank's part of the Delaunay triangulation of all ranks' points: together the ranks
/// have the triangles that triangulate() returns. Of coincident points, on any ranks, the one with
/// the lowest global id represents all. Collective; throws RankFailure on all ranks if any rank
/// fails or its Progress stops the run.
VTKTIPPFILTERS_EXPORT DistributedTriangulation triangulateDistributed(
  Communicator& ranks, const RankPoints& points, const DistributedOptions& options = {});

} // namespace tipp

#endif
