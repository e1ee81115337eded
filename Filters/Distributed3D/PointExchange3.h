// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointExchange3_h
#define tippPointExchange3_h

#include "Distributed/CellExchange.h"
#include "Predicates/Points.h"
#include "Ranks/Communicator.h"
#include "Triangulation3D/Tiling3.h"

#include <cstddef>

namespace tipp
{

/// A rank's input points in space. Does not own the memory.
struct RankPoints3 : RankPointData
{
  const Point3* Points = nullptr;
  std::size_t Count = 0;
};

using PointTuples3 = PointTuplesOf<Point3>;

/// Sends each finite point to the rank that owns the partition containing it, and multiplies its
/// coordinates by `factor`. Returns this rank's points: sorted by the rank that had them, and then
/// in that rank's order. Collective. Throws RankFailure.
PointTuples3 exchangePoints(Communicator& ranks, const RankPoints3& points, const Tiling3& tiling,
  double factor, int threads);

} // namespace tipp

#endif
