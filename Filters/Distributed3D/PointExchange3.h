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

/// Sends each finite point to the rank whose group of partitions contains it, its coordinates times
/// `factor`. A rank's points come in the order of the ranks that had them, and of each in its
/// order. Collective.
PointTuples3 exchangePoints(Communicator& ranks, const RankPoints3& points, const Tiling3& tiling,
  double factor, int threads);

} // namespace tipp

#endif
