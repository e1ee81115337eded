// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMajorStages_h
#define tippMajorStages_h

#include "Distributed/DistributedOptions.h"
#include "Triangulation/Tiling.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// The sets of major partitions that are likely to be active together, by the conflicts in a mesh
/// of the sample. Points can so go to their workers before the triangulation begins.
std::vector<std::vector<PartitionIndex>> predictStages(const Tiling& majors,
  const std::vector<Point2>& sample, const std::vector<std::int64_t>& majorCounts);

/// For each major partition of a stage the ranks of the group that works on it. In a stage with
/// fewer major partitions than ranks each group has several ranks, in proportion to the points
/// (equation 3.2); else a group is one rank, the one with the fewest points so far (its load).
void formGroups(const std::vector<PartitionIndex>& active,
  const std::vector<std::int64_t>& majorCounts, const std::vector<std::int32_t>& ranks,
  const DistributedOptions& options, std::vector<double> load,
  std::vector<std::vector<std::int32_t>>& groups);

} // namespace tipp

#endif
