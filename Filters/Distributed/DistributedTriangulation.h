// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedTriangulation_h
#define tippDistributedTriangulation_h

#include "Distributed/DistributedOptions.h"
#include "Distributed/DistributedStatistics.h"
#include "Distributed/PointExchange.h"
#include "Messages/Postbox.h"
#include "Triangulation/Buffer.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <vector>

namespace tipp
{

struct PointTuples
{
  Buffer<Point2> Places;
  Buffer<PointId> GlobalIds;
  Buffer<char> Rows; ///< as RankPoints::PackRow wrote them
  std::size_t size() const { return this->Places.size(); }
};

/// A rank's part of a triangulation. Its triangles name the rank's own points, and after them
/// those of other ranks that it has triangles with, by their places in Owned and Foreign.
struct DistributedTriangulation
{
  Buffer<std::int32_t> Ids32; ///< used when every place fits
  Buffer<std::int64_t> Ids64;
  PointTuples Owned; ///< also points that no triangle here has
  PointTuples Foreign;
  std::size_t RowSize = 0;
  std::vector<std::int64_t> ForeignIds; ///< counted over all ranks' owned points; ascending
  std::vector<std::int64_t> FirstIds;   ///< of each rank's owned points in that count; and the end

  std::int64_t FirstTriangle = 0;    ///< the number of this rank's first triangle among all
  std::vector<Duplicate> Duplicates; ///< found here, by global ids
  std::vector<PointId> Rejected;     ///< brought by this rank, by global ids

  std::int64_t AllPoints = 0; ///< of all ranks together
  std::int64_t AllTriangles = 0;
  std::int64_t AllDuplicates = 0;
  std::int64_t AllRejected = 0;
  DistributedStatistics Statistics;

  std::size_t triangleCount() const { return (this->Ids32.size() + this->Ids64.size()) / 3; }
};

/// The Delaunay triangulation of all ranks' points: the set of triangles that triangulate() makes
/// of them. Of points at one place, on whatever ranks, the one of lowest global id stands for all.
/// Collective; throws RankFailure on all ranks if any rank fails or its Progress stops the run.
VTKTIPPFILTERS_EXPORT DistributedTriangulation triangulateDistributed(
  Postbox& ranks, const RankPoints& points, const DistributedOptions& options = {});

} // namespace tipp

#endif
