// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPlan3_h
#define tippPlan3_h

#include "Arrays/Concatenated.h"
#include "Distributed/PointExchange.h"
#include "Triangulation3D/Partitions3.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tipp
{

using RankPoints3 = RankPointsOf<3>;
using PointTuples3 = PointTuplesOf<Point3>;

/// Chooses the numbers and shapes of partitions. If slabs are thick enough, parallel slabs are
/// best, because they pass on the fewest vertices: one per thread, which triangulates its points
/// while it waits for the neighbours' vertices. Otherwise there are enough boxes to keep all
/// threads busy.
inline PartitionGroups chooseGroups(std::int64_t points, int ranks, int threads, int wanted)
{
  constexpr double thick = 10; // in average distances between points
  constexpr int boxesOfThread = 12;
  constexpr int most = 512;
  constexpr double hull = 1; // the first rank gets fewer points because it repairs the hull
  constexpr std::int64_t largest = std::int64_t(1) << 25;
  const double slabs = std::cbrt(double(points)) / thick;
  PartitionGroups groups;
  groups.Count = ranks;
  groups.FirstLess = std::min(0.5, hull / std::cbrt(double(std::max<std::int64_t>(points, 1))));
  groups.AreSlabs = ranks <= slabs;
  groups.ArePartitionsSlabs = groups.AreSlabs && ranks * threads <= slabs && wanted == 0;
  groups.Each = wanted > 0 ? (wanted + ranks - 1) / ranks
                           : (groups.ArePartitionsSlabs ? 1 : boxesOfThread) * threads;
  groups.Each = std::clamp(groups.Each, 1, std::max(1, most / ranks));
  groups.Each = std::max(groups.Each, int(points / ranks / largest));
  return groups;
}

/// Sends each finite point to the rank that owns the partition containing it. Returns this rank's
/// points: sorted by the rank that had them, and then in that rank's order. Collective. Throws
/// RankFailure.
inline PointTuples3 exchangePoints(
  Communicator& ranks, const RankPoints3& points, const Tiling3& tiling, int threads)
{
  // A leaf is a group of partitions, and belongs to the rank with its index.
  std::vector<std::int32_t> owners(std::size_t(ranks.size()));
  std::iota(owners.begin(), owners.end(), 0);
  const PointSender<Point3, PointsView3> sender(points, points.Points, owners.size(), threads,
    [&](std::size_t begin, std::size_t end, std::uint32_t* labels, std::vector<std::size_t>& counts)
    {
      points.Points.forEach(begin, end,
        [&](std::size_t i, const Point3& p)
        {
          labels[i] = PartitionFinder::None;
          if (isFinite(p))
          {
            labels[i] = std::uint32_t(tiling.groupOf(tiling.locate(p)));
            ++counts[labels[i]];
          }
        });
    });
  const PointLayout layout(ranks, owners, sender.counts());
  const auto packing = sender.plan(owners, layout);
  PointTuples3 owned = sender.makeRoom(layout);
  sender.send(ranks, owners, layout, packing, Bytes(packing.Size), owned);
  return owned;
}

/// Chooses initial points of this rank's partitions, and returns those of all ranks, with the
/// regions of all partitions. `buckets`: this rank's points, whose internal ids are those in
/// `buckets` plus `firstId`. Ids in the result are indices into `ids`, which is set to the internal
/// ids. A partition without points has no initial points. Collective.
inline PointBuckets3 shareInitialPoints(Communicator& ranks, const Tiling3& tiling,
  std::int64_t firstId, const PointBuckets3& buckets, std::vector<std::int64_t>& ids)
{
  // With more points, fewer partitions conflict. There are enough if tetrahedra are much smaller
  // than partitions, even if these are slabs.
  constexpr std::size_t most = 8192;
  constexpr std::size_t share = 16; // at most one in this many of a partition's points
  const auto partitions = std::size_t(tiling.size());
  const std::size_t each = std::min(most, 128 * partitions * partitions * partitions) / partitions;
  std::vector<Box3> regions;
  std::vector<Vertex3> initial;
  for (PartitionIndex p = 0; p < tiling.size(); ++p)
  {
    if (tiling.groupOf(p) != ranks.rank())
    {
      continue;
    }
    regions.push_back(buckets.Regions[std::size_t(p)]);
    const PartitionPoints3 points = buckets.of(p, firstId);
    if (points.Count > 0)
    {
      for (const std::size_t i : chooseInitialPoints(points.Points, points.Count,
             std::max(InitialPointsOfPartition3, std::min(each, points.Count / share))))
      {
        initial.push_back({ points.Points[i], points.id(i), p });
      }
    }
  }
  PointBuckets3 all;
  all.Regions = concatenated(ranks.allGather(regions));
  all.Begins.assign(partitions + 1, 0);
  for (const Vertex3& v : concatenated(ranks.allGather(initial)))
  {
    all.Points.push_back(v.Position);
    all.Ids.push_back(std::int32_t(ids.size()));
    ids.push_back(v.Id);
    all.Begins.at(std::size_t(v.Partition) + 1) = ids.size();
  }
  // Partitions without points begin where the one before them ends.
  std::partial_sum(all.Begins.begin(), all.Begins.end(), all.Begins.begin(),
    [](std::size_t a, std::size_t b) { return std::max(a, b); });
  return all;
}

} // namespace tipp

#endif
