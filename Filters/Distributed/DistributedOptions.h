// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDistributedOptions_h
#define tippDistributedOptions_h

#include <cstdint>
#include <functional>

namespace tipp
{

/// Who starts partitions.
enum class Masters
{
  Auto,   ///< no master; several where a grid of major partitions is given, or one for schedules
          ///< with barriers
  Single, ///< one master hands out all partitions (Algorithm 1)
  Multi   ///< a master hands major partitions to sub-masters (Algorithm 3)
};

/// How a domain or a major partition is cut into (minor) partitions.
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

/// When ranks get partitions.
enum class RankSchedule
{
  Stages,           ///< waves of independent partitions, a barrier after each (Algorithm 1)
  ProducerConsumer, ///< a free worker asks for the next; a barrier after each stage
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
  GridSize Minor;             ///< for Division::Grid; with one master, the partitions
  std::int64_t Threshold = 0; ///< T, points per minor partition; 0: chosen
  GroupSizes Groups = GroupSizes::Proportional;
  RankSchedule Order = RankSchedule::Dynamic;
  int InitialPointsPerPartition = 0; ///< 0: chosen
  int Threads = 0;                   ///< of each rank; 0: OpenMP's choice
  /// Called now and then with this rank's finished fraction (0 to 1); returning false ends the run
  /// on all ranks.
  std::function<bool(double)> Progress;
};

} // namespace tipp

#endif
