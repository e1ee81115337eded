// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlan_h
#define tippPlan_h

#include "Ranks/Archive.h"
#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Which rank keeps inboxes and starts partitions.
enum class Masters
{
  Auto,   ///< no master, unless a grid of major partitions is given (then several) or the schedule
          ///< has barriers (then one)
  Single, ///< one master hands out all partitions (Algorithm 1)
  Multi   ///< a master hands major partitions to sub-masters (Algorithm 3)
};

/// How a domain or a major partition is divided into (minor) partitions.
enum class Division
{
  Tree,      ///< boxes that hold equally many points
  Threshold, ///< m x m boxes with m = sqrt(N / T) for N points (equation 3.1)
  Grid       ///< the same number of columns and rows everywhere
};

/// How many ranks and partitions a major partition gets.
enum class GroupSizes
{
  Proportional, ///< ranks and partitions in proportion to points (equation 3.2)
  Equal         ///< equal numbers
};

/// When partitions are started on the ranks.
enum class RankSchedule
{
  Stages,           ///< waves of independent partitions, a barrier after each (Algorithm 1)
  ProducerConsumer, ///< a free worker takes the next partition; a barrier after each stage
  Dynamic           ///< no barrier
};

/// The size of a grid of partitions; not given by default.
struct GridSize
{
  int Columns = 0;
  int Rows = 0;
  bool isGiven() const { return this->Columns > 0 && this->Rows > 0; }
  std::int64_t size() const { return std::int64_t(this->Columns) * this->Rows; }
};

/// Options of triangulateDistributed(); none of them changes the set of triangles.
struct DistributedOptions
{
  bool isMasterless() const
  {
    return this->Design == Masters::Auto && !this->Major.isGiven() &&
      this->Order == RankSchedule::Dynamic;
  }

  Masters Design = Masters::Auto;
  GridSize Major; ///< default: a tree with an automatic number of boxes
  Division MinorDivision = Division::Tree;
  GridSize Minor;             ///< for Division::Grid; with one master, the grid of all partitions
  std::int64_t Threshold = 0; ///< T, points per minor partition; 0: chosen automatically
  GroupSizes Groups = GroupSizes::Proportional;
  RankSchedule Order = RankSchedule::Dynamic;
  int InitialPointsPerPartition = 0; ///< 0: chosen automatically
  int Threads = 0;                   ///< threads of each rank; 0: defaultThreads()
  /// Called now and then with this rank's finished fraction (0 to 1); returning false ends the run
  /// on all ranks.
  std::function<bool(double)> Progress;
};

/// The partitions of one master: of the whole domain, or of a major partition.
struct Area
{
  Tiling Boxes;                 ///< its partitions
  PartitionIndex FirstLeaf = 0; ///< index of its first partition among the leaves
  std::int32_t Lead = 0;        ///< the master's rank
};

/// Which rank triangulates which partition.
struct VTKTIPPFILTERS_EXPORT Plan
{
  /// The domain's area first, then one for each major partition, if there are any. In that case the
  /// leaves belong to the areas of the major partitions.
  std::vector<Area> Areas;
  Tiling Leaves;                    ///< all partitions that are triangulated, in one tiling
  std::vector<std::int32_t> Owners; ///< by leaf: the rank that owns its points

  /// Returns whether there is only one leaf. Then there are no initial mesh and no artificial
  /// points.
  bool isAlone() const { return this->Leaves.size() == 1; }
  /// Returns the number of major partitions; 0: one master.
  PartitionIndex majors() const { return static_cast<PartitionIndex>(this->Areas.size()) - 1; }
  /// With masters: returns the rank of each leaf's master.
  std::vector<std::int32_t> masters() const;
};

template <typename Archive>
void serialize(Archive& archive, Area& area)
{
  archive(area.Boxes, area.FirstLeaf, area.Lead);
}

template <typename Archive>
void serialize(Archive& archive, Plan& plan)
{
  archive(plan.Areas, plan.Leaves, plan.Owners);
}

/// The input of a plan.
struct PlanInput
{
  Box2 Domain{};              ///< bounds of all ranks' finite points
  std::int64_t Points = 0;    ///< number of points of all ranks
  std::vector<Point2> Sample; ///< evenly spaced points of all ranks
  int Ranks = 1;              ///< number of ranks
  int Threads = 1;            ///< sum over all ranks
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
