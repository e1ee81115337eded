// SPDX-License-Identifier: BSD-3-Clause
// What each partition costs when points are shared out to many ranks: one process triangulates all
// partitions, one after the other, and prints for each what cluster_model.py needs to know.
#include "Distributed/Plan.h"
#include "Engine/Routing.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Triangulation/InitialMesh.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>

namespace
{

using namespace tipp;

Box2 boundsOf(const PointsView& points)
{
  Box2 box{ points[0].x, points[0].y, points[0].x, points[0].y };
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const Point2 p = points[i];
    box = { std::min(box.xmin, p.x), std::min(box.ymin, p.y), std::max(box.xmax, p.x),
      std::max(box.ymax, p.y) };
  }
  return box;
}

/// The plan that so many ranks of one thread would make, and the points in its partitions.
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

/// The mesh as the ranks exchange it, and how many bytes that is.
std::vector<BoundaryTriangles> sharesOf(
  const BoundaryTriangles& mesh, int ranks, std::size_t& bytes)
{
  std::vector<BoundaryTriangles> shares(static_cast<std::size_t>(ranks));
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    shares[i * shares.size() / mesh.size()].add(
      mesh.Triangles[i], mesh.metBegin(i), mesh.metEnd(i));
  }
  bytes = mesh.size() * (sizeof(BoundaryTriangles::Corners) + sizeof(std::uint32_t));
  for (const BoundaryTriangles& share : shares)
  {
    for (std::uint32_t set = 0; set < share.Sets.size(); ++set)
    {
      const std::ptrdiff_t members = share.Sets.end(set) - share.Sets.begin(set);
      bytes += sizeof(std::uint64_t) + std::size_t(members) * sizeof(PartitionIndex);
    }
  }
  return shares;
}

/// A line for each partition in order: its rank, seconds, vertices, and of each later conflicting
/// partition its number and how many vertices are sent to it.
void printPartitions(SharedOut& shared)
{
  const Tiling& tiles = shared.Of.Leaves;
  const Regions regions(tiles, shared.Buckets, 1);
  std::vector<BoundaryVertex> initial =
    chooseInitialPoints(tiles, shared.Buckets, InitialPointsOfPartition, 1);
  const std::vector<BoundaryVertex> artificial = makeArtificialPoints(tiles);
  initial.insert(initial.end(), artificial.begin(), artificial.end());
  std::size_t bytes = 0;
  std::vector<BoundaryTriangles> shares;
  InitialMeshShare share;
  if (shared.Ranks > 1)
  {
    shares = sharesOf(triangulateVertices(regions, initial, 1), shared.Ranks, bytes);
    share = { 0, shared.Ranks, [&](BoundaryTriangles&&) { return std::move(shares); } };
  }
  const ProcessorWatch initialWatch; // what every rank does
  const BoundaryTriangles mesh = triangulateVertices(regions, initial, 1, share);
  const PartitionOrder order(regions.areUsed(), mesh);
  std::vector<Inbox> inboxes(order.partitionCount());
  FinalBoundary<std::int64_t> final;
  const DeliverMessage deliver = [&](PartitionIndex to, VertexMessage&& message)
  { inboxes[std::size_t(to)].put(std::move(message)); };
  sendInitialMesh(mesh, order, deliver, final);
  std::printf("initial %zu points %.6f seconds %zu colours %zu bytes exchanged\n", initial.size(),
    initialWatch.seconds(), order.colourCount(), bytes);

  Worker<std::int32_t> worker(tiles, shared.Buckets);
  Routing<std::int32_t> routing(order, regions);
  UniqueVertices unique;
  for (const PartitionIndex p : order.sequence())
  {
    std::map<PartitionIndex, std::size_t> sent;
    const ProcessorWatch watch;
    routing.setPartition(p);
    worker.triangulate(p, unique.collect(inboxes[std::size_t(p)].take()), regions[p], routing);
    routing.send(
      worker,
      [&](PartitionIndex to, VertexMessage&& message)
      {
        sent[to] = message.Vertices.size();
        deliver(to, std::move(message));
      },
      final);
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
