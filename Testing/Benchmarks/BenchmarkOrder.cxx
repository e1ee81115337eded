// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of each partition when points are distributed over many ranks. One process
// triangulates all partitions one after the other, and prints the input of cluster_model.py.
#include "Distributed/Plan.h"
#include "Distributed/SharedInitialMesh.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

namespace
{

using namespace tipp;

Box2 boundsOf(const PointsView& points)
{
  Box2 box = Box2::of(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    box.extend(points[i]);
  }
  return box;
}

/// The plan that `ranks` ranks of one thread each would make, and the points in its partitions.
struct SharedOut
{
  SharedOut(const PointsView& points, int ranks, int perRank)
    : Ranks(ranks)
  {
    const auto count = std::int64_t(points.size());
    DistributedOptions options;
    options.Threshold = std::max<std::int64_t>(1, count / (std::int64_t(ranks) * perRank));
    PlanInput input;
    input.Domain = boundsOf(points);
    input.Points = count;
    input.Ranks = ranks;
    input.Threads = ranks;
    const std::size_t wanted = SamplesPerPartition * std::size_t(ranks) * std::size_t(perRank);
    const std::size_t step = std::max<std::size_t>(1, points.size() / wanted);
    for (std::size_t i = 0; i < points.size(); i += step)
    {
      input.Sample.push_back(points[i]);
    }
    this->Of = divide(input, options);
    this->Buckets = bucketPoints<std::int32_t>(points, this->Of.Leaves, 1);
    std::vector<std::int64_t> counts;
    for (PartitionIndex p = 0; p < this->Of.Leaves.size(); ++p)
    {
      counts.push_back(std::int64_t(this->Buckets.count(p)));
    }
    assign(this->Of, input, counts, options);
  }

  int Ranks;
  Plan Of;
  PointBuckets<std::int32_t> Buckets;
};

/// Each rank's part of the initial mesh, and the order that all ranks compute from the parts.
struct SharedOrder
{
  SharedOrder(const SharedOut& shared, const Regions& regions,
    const std::vector<BoundaryVertex>& initial, const std::vector<BoundaryVertex>& artificial)
  {
    std::vector<PartConflicts> conflicts;
    for (int rank = 0; rank < shared.Ranks; ++rank)
    {
      std::vector<char> isChosen;
      for (const std::int32_t owner : shared.Of.Owners)
      {
        isChosen.push_back(owner == rank);
      }
      const ProcessorWatch watch;
      this->Parts.emplace_back(regions, initial, artificial, isChosen, 1);
      conflicts.push_back(this->Parts.back().conflicts());
      this->PartSeconds.push_back(watch.seconds());
    }
    this->Exchanged = packed(conflicts).size();
    const ProcessorWatch watch;
    this->Order = std::make_unique<PartitionOrder>(
      regions.areUsed(), joinConflicts(conflicts, regions.areUsed().size()));
    this->OrderSeconds = watch.seconds();
  }

  std::vector<InitialMeshPart> Parts;
  std::vector<double> PartSeconds;
  std::unique_ptr<PartitionOrder> Order;
  double OrderSeconds = 0;
  std::size_t Exchanged = 0; ///< bytes of the conflicts in all parts
};

/// Prints a line for each partition, in order: rank, seconds, vertices, and for each later
/// conflicting partition its index and the number of vertices sent to it.
void printPartitions(SharedOut& shared)
{
  const Tiling& tiles = shared.Of.Leaves;
  const Regions regions(tiles, shared.Buckets, 1);
  std::vector<BoundaryVertex> initial =
    chooseInitialPoints(tiles, shared.Buckets, InitialPointsOfPartition, 1);
  keepOneOfEachPosition(initial);
  const SharedOrder agreed(shared, regions, initial, makeArtificialPoints(tiles));
  const PartitionOrder& order = *agreed.Order;
  std::vector<Inbox> inboxes(order.partitionCount());
  FinalBoundary<std::int64_t> final;
  double longest = 0; // the longest time that a rank needs before its first partition
  double sum = 0;
  for (std::size_t rank = 0; rank < agreed.Parts.size(); ++rank)
  {
    const InitialMeshPart& part = agreed.Parts[rank];
    const ProcessorWatch watch;
    for (auto& [to, message] : sendInitialMesh(part.Mesh, order))
    {
      if (part.IsChosen[std::size_t(to)])
      {
        inboxes[std::size_t(to)].put(std::move(message));
      }
    }
    const double seconds = agreed.PartSeconds[rank] + agreed.OrderSeconds + watch.seconds();
    longest = std::max(longest, seconds);
    sum += seconds;
  }
  std::printf("initial %zu points %.6f seconds %zu colours %zu bytes exchanged\n", initial.size(),
    longest, order.colourCount(), agreed.Exchanged);
  std::fprintf(stderr, "order %.3f s, a rank's part and order %.3f s on average, %.3f s at most\n",
    agreed.OrderSeconds, sum / shared.Ranks, longest);

  Worker<std::int32_t> worker(tiles, shared.Buckets);
  Routing<std::int32_t> routing(order, regions);
  for (const PartitionIndex p : order.sequence())
  {
    std::map<PartitionIndex, std::size_t> sent;
    const ProcessorWatch watch;
    routing.triangulate(worker, p, inboxes[std::size_t(p)].take());
    for (auto& [to, message] : routing.send(worker, final))
    {
      sent[to] = message.Vertices.size();
      inboxes[std::size_t(to)].put(std::move(message));
    }
    const double seconds = watch.seconds();
    std::printf(
      "%d %d %.9f %zu", p, shared.Of.Owners[std::size_t(p)], seconds, worker.vertexCount());
    for (const PartitionIndex q : order.later(p))
    {
      std::printf(" %d:%zu", q, sent[q]);
    }
    std::printf("\n");
  }
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    const int ranks = argc > 2 ? std::atoi(argv[2]) : 0;
    const int perRank = argc > 3 ? std::atoi(argv[3]) : 64;
    if (ranks < 1 || perRank < 1)
    {
      std::puts("benchmarkOrder POINTS.npy RANKS [PARTITIONS_OF_A_RANK]");
      return 2;
    }
    const std::vector<double> xy = readPoints(argv[1]).XY;
    SharedOut shared(PointsView(xy.data(), xy.size() / 2, 2), ranks, perRank);
    std::printf(
      "# %d ranks, %zu points, %d partitions\n", ranks, xy.size() / 2, shared.Of.Leaves.size());
    printPartitions(shared);
    return 0;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "benchmarkOrder: %s\n", error.what());
    return 1;
  }
}
