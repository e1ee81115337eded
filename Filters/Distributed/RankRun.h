// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankRun_h
#define tippRankRun_h

#include "Distributed/Dispatcher.h"
#include "Distributed/DistributedStatistics.h"
#include "Distributed/FinalTriangles.h"
#include "Distributed/InitialPoints.h"
#include "Distributed/LeafWorkers.h"
#include "Distributed/PointExchange.h"
#include "Messages/Postbox.h"
#include "Parallel/Stopwatch.h"

#include <map>
#include <memory>
#include <vector>

namespace tipp
{

/// A rank's part of the triangulation: its main thread answers messages, looks after the areas it
/// is master of, and feeds its threads.
template <typename Id>
class RankRun
{
public:
  RankRun(Postbox& ranks, const Plan& plan, OwnedPoints<Id>& points,
    const std::vector<std::int64_t>& leafCounts, const DistributedOptions& options, int threads);

  /// Collective.
  void run();

  /// Boundary triangles that have become final on this rank, by internal ids.
  FinalTriangles Kept;
  std::vector<Duplicate> Duplicates;       ///< by internal ids
  std::vector<std::size_t> InteriorCounts; ///< of each leaf
  RankStatistics Statistics;
  std::vector<MasterStatistics> Masters; ///< of the areas this rank was master of
  bool PartitionsPay = true;             ///< known on all ranks; if not, nothing was done

private:
  void beginTop();
  void beginArea(std::int32_t parent, Task task);
  void beginDispatcher(std::int32_t index, const SeamTriangles& mesh);
  std::vector<PartitionIndex> withPoints(const Area& area) const;
  int capacity(const Area& area) const;
  void handle(Message& message);
  void handleTask(Task task);
  void deliver(std::int32_t master, TaskResult result);
  void dispatchAll();
  void giveTo(std::int32_t rank, Task task);
  void finishArea(std::int32_t index);
  void finishTop(Dispatcher& top);
  void keepFigures(const Dispatcher& dispatcher, std::int32_t index);
  bool step();
  void wait();
  void report();

  struct Active
  {
    std::unique_ptr<Dispatcher> Master;
    std::int32_t Parent = -1; ///< area, and
    PartitionIndex Partition = 0;
    double MoreSeconds = 0; ///< of the master's work outside the dispatcher
  };

  Postbox& Ranks;
  const Plan& Work;
  OwnedPoints<Id>& Points;
  const std::vector<std::int64_t>& LeafCounts;
  const DistributedOptions& Options;
  const int Threads;
  LeafWorkers<Id> Workers;
  InitialPointsOfAreas InitialPoints;
  std::map<std::int32_t, Active> Dispatchers; ///< by area
  std::vector<SeamVertex> Artificial;
  bool Finished = false;
  double TaskSeconds = 0; ///< that the last partition took
  Stopwatch SinceReport;
};

extern template class RankRun<std::int32_t>;
extern template class RankRun<std::int64_t>;

} // namespace tipp

#endif
