// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippShareInitialPoints3_h
#define tippShareInitialPoints3_h

#include "Ranks/Communicator.h"
#include "Triangulation3D/Tiling3.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Chooses initial points of this rank's partitions, and returns those of all ranks, with the
/// regions of all partitions. `buckets`: this rank's points, whose internal ids are those in
/// `buckets` plus `firstId`. Ids in the result are indices into `ids`, which is set to the internal
/// ids. A partition without points has no initial points. Collective.
PointBuckets3 shareInitialPoints(Communicator& ranks, const Tiling3& tiling, std::int64_t firstId,
  const PointBuckets3& buckets, std::vector<std::int64_t>& ids);

} // namespace tipp

#endif
