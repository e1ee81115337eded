// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInitialPoints_h
#define tippInitialPoints_h

#include "Distributed/DistributedOptions.h"
#include "Distributed/Plan.h"
#include "Distributed/PointExchange.h"
#include "Distributed/SeamGroups.h"
#include "Messages/Postbox.h"

#include <cstdint>
#include <map>
#include <vector>

namespace tipp
{

/// What the meshes of areas begin with, by area.
using InitialPointsOfAreas = std::map<std::int32_t, std::vector<PlainVertex>>;

/// Every owner sends some points of its leaves to the masters of their areas, and fewer to the
/// whole domain's: returns those of the areas that this rank is master of. Collective.
template <typename Id>
InitialPointsOfAreas gatherInitialPoints(Postbox& ranks, const Plan& plan,
  const OwnedPoints<Id>& points, const std::vector<std::int64_t>& leafCounts,
  const DistributedOptions& options);

extern template InitialPointsOfAreas gatherInitialPoints(Postbox&, const Plan&,
  const OwnedPoints<std::int32_t>&, const std::vector<std::int64_t>&, const DistributedOptions&);
extern template InitialPointsOfAreas gatherInitialPoints(Postbox&, const Plan&,
  const OwnedPoints<std::int64_t>&, const std::vector<std::int64_t>&, const DistributedOptions&);

} // namespace tipp

#endif
