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

/// The partitions that one master hands to workers, or to masters of their own.
struct Area
{
  Tiling Boxes;                       ///< its partitions
  PartitionIndex Inner = 0;           ///< the number of partitions
  PartitionIndex FirstLeaf = 0;       ///< index of its first partition among the leaves
  std::vector<std::int32_t> Children; ///< by partition: its area; empty: partitions are leaves
  std::vector<std::vector<std::int32_t>> Homes; ///< groups of ranks
  std::vector<std::int32_t> HomeOf;             ///< by partition: the index of its group in Homes
  std::int32_t Lead = 0;                        ///< the master's rank

  bool hasLeaves() const { return this->Children.empty(); }
};

/// Which rank triangulates which partition. The first area is the whole domain's.
struct VTKTIPPFILTERS_EXPORT Plan
{
  std::vector<Area> Areas;
  Tiling Leaves;                    ///< all partitions that are triangulated, in one tiling
  std::vector<std::int32_t> Owners; ///< by leaf: the rank that owns its points
  bool IsAlone = false;             ///< one leaf: no initial mesh, no artificial points

  /// With masters: returns the rank of each leaf's master.
  std::vector<std::int32_t> masters() const;

  void write(ByteWriter& writer) const;
  static Plan read(ByteReader& reader);
};

/// What a plan depends on.
struct PlanInput
{
  Box2 Domain{};
  std::int64_t Points = 0;
  std::vector<Point2> Sample;
  int Ranks = 1;
  int Threads = 1; ///< sum over all ranks
};

/// The number of sample points that a plan needs.
std::size_t wantedSample(std::int64_t points, const DistributedOptions& options, int threads);

/// Returns the areas and leaves, not yet assigned to ranks.
VTKTIPPFILTERS_EXPORT Plan divide(const PlanInput& input, const DistributedOptions& options);

/// Returns a plan with one leaf, owned by the first rank.
Plan planAlone(const Box2& domain);

/// Assigns the partitions to ranks; `leafCounts` has the number of points of each leaf.
VTKTIPPFILTERS_EXPORT void assign(Plan& plan, const PlanInput& input,
  const std::vector<std::int64_t>& leafCounts, const DistributedOptions& options);

} // namespace tipp

#endif
