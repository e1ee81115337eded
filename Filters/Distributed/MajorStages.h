// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMajorStages_h
#define tippMajorStages_h

#include "Distributed/DistributedOptions.h"
#include "Triangulation/Tiling.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Predicts which major partitions will be active together, from the conflicts in a mesh of the
/// sample, so that points can be sent to their workers before the triangulation begins. Returns the
/// stages, each a set of major partitions with points.
std::vector<std::vector<PartitionIndex>> predictStages(const Tiling& majors,
  const std::vector<Point2>& sample, const std::vector<std::int64_t>& majorCounts);

/// Chooses the group of ranks for each major partition of a stage. If a stage has fewer major
/// partitions than ranks, each group has several ranks, in proportion to the points (equation 3.2);
/// else a group is one rank, the one with the lowest load, its points so far.
void formGroups(const std::vector<PartitionIndex>& active,
  const std::vector<std::int64_t>& majorCounts, const std::vector<std::int32_t>& ranks,
  const DistributedOptions& options, std::vector<double> load,
  std::vector<std::vector<std::int32_t>>& groups);

} // namespace tipp

#endif
