// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrossingPairs_h
#define tippCrossingPairs_h

#include "Constraints/SegmentTree.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The Ids of two segments that cross, the lower first.
using CrossingPair = std::array<std::int64_t, 2>;

/// All pairs of segments that cross at a point in the interior of both, sorted. Exact.
VTKTIPPFILTERS_EXPORT std::vector<CrossingPair> findCrossingPairs(
  std::vector<SegmentTree::Item> segments, int threads);

} // namespace tipp

#endif
