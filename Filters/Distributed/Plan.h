// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlan_h
#define tippPlan_h

#include "Distributed/DistributedOptions.h"
#include "Messages/Bytes.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// What one master looks after: partitions that are handed to workers, or to masters of their own.
struct Area
{
  Tiling Boxes;                       ///< its partitions
  PartitionIndex Inner = 0;           ///< the number of its partitions
  PartitionIndex FirstLeaf = 0;       ///< of its partitions in the order of leaves
  std::vector<std::int32_t> Children; ///< the area of each partition; none: they are leaves
  std::vector<std::vector<std::int32_t>> Homes; ///< groups of ranks
  std::vector<std::int32_t> HomeOf;             ///< of each partition, the group that works on it
  std::int32_t Lead = 0;                        ///< its master's rank

  bool hasLeaves() const { return this->Children.empty(); }
};

/// Who triangulates what. The first area is the whole domain's.
struct VTKTIPPFILTERS_EXPORT Plan
{
  std::vector<Area> Areas;
  Tiling Leaves;                    ///< all partitions that are triangulated, in one tiling
  std::vector<std::int32_t> Owners; ///< of each leaf, the rank that has its points
  bool IsAlone = false;             ///< one leaf: no initial mesh, no artificial points

  /// With masters: of each leaf, the rank of its master.
  std::vector<std::int32_t> masters() const;

  void write(ByteWriter& writer) const;
  static Plan read(ByteReader& reader);
};

struct PlanInput
{
  Box2 Domain{};
  std::int64_t Points = 0;
  std::vector<Point2> Sample;
  int Ranks = 1;
  int Threads = 1; ///< of all ranks together
};

/// Points of the sample that a plan wants.
std::size_t wantedSample(std::int64_t points, const DistributedOptions& options, int threads);

/// The areas and leaves, with nobody to work on them yet.
VTKTIPPFILTERS_EXPORT Plan divide(const PlanInput& input, const DistributedOptions& options);

/// One leaf, the first rank's.
Plan planAlone(const Box2& domain);

/// Shares the partitions out, given the points of each leaf.
VTKTIPPFILTERS_EXPORT void assign(Plan& plan, const PlanInput& input,
  const std::vector<std::int64_t>& leafCounts, const DistributedOptions& options);

} // namespace tipp

#endif
