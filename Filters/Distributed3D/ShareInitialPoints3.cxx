// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed3D/ShareInitialPoints3.h"

#include "Triangulation3D/InitialMesh3.h"

#include <algorithm>
#include <numeric>

namespace tipp
{
namespace
{

/// The initial points of one rank's partitions, in the order of the partitions.
struct InitialPoints3
{
  std::vector<Box3> Regions;
  std::vector<std::int64_t> Chosen; ///< by partition: its number of Points
  std::vector<Point3> Points;
  std::vector<std::int64_t> Ids; ///< internal ids
};

template <typename Archive>
void serialize(Archive& archive, InitialPoints3& initial)
{
  archive(initial.Regions, initial.Chosen, initial.Points, initial.Ids);
}

InitialPoints3 chooseInitial(const Communicator& ranks, const Tiling3& tiling, std::int64_t firstId,
  const PointBuckets3& buckets)
{
  // With more points, fewer partitions conflict. There are enough if tetrahedra are much smaller
  // than partitions, even if these are slabs.
  constexpr std::size_t most = 8192;
  constexpr std::size_t share = 16; // at most one in this many of a partition's points
  const auto partitions = std::size_t(tiling.size());
  const std::size_t each = std::min(most, 128 * partitions * partitions * partitions) / partitions;
  InitialPoints3 initial;
  for (PartitionIndex p = 0; p < tiling.size(); ++p)
  {
    if (tiling.groupOf(p) != ranks.rank())
    {
      continue;
    }
    const PartitionPoints3 points = buckets.of(p, firstId);
    std::vector<std::size_t> chosen;
    if (points.Count > 0)
    {
      chosen = chooseInitialPoints(points.Points, points.Count,
        std::max(InitialMesh3::PointsOfPartition, std::min(each, points.Count / share)));
    }
    initial.Regions.push_back(buckets.Regions[std::size_t(p)]);
    initial.Chosen.push_back(std::int64_t(chosen.size()));
    for (const std::size_t i : chosen)
    {
      initial.Points.push_back(points.Points[i]);
      initial.Ids.push_back(points.id(i));
    }
  }
  return initial;
}

} // namespace

PointBuckets3 shareInitialPoints(Communicator& ranks, const Tiling3& tiling, std::int64_t firstId,
  const PointBuckets3& buckets, std::vector<std::int64_t>& ids)
{
  PointBuckets3 all;
  std::size_t next = 0;
  for (const InitialPoints3& part : ranks.allGather(chooseInitial(ranks, tiling, firstId, buckets)))
  {
    for (const std::int64_t chosen : part.Chosen)
    {
      all.Begins.push_back(next);
      next += std::size_t(chosen);
    }
    all.Regions.insert(all.Regions.end(), part.Regions.begin(), part.Regions.end());
    all.Points.insert(all.Points.end(), part.Points.begin(), part.Points.end());
    ids.insert(ids.end(), part.Ids.begin(), part.Ids.end());
  }
  all.Begins.push_back(next);
  all.Ids.resize(all.Points.size());
  std::iota(all.Ids.begin(), all.Ids.end(), 0);
  return all;
}

} // namespace tipp
