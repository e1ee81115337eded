// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/MajorStages.h"

#include "Engine/PartitionOrder.h"
#include "Triangulation/InitialMesh.h"

#include <algorithm>
#include <numeric>

namespace tipp
{
namespace
{

using Ranks = std::vector<std::int32_t>;

/// Some sample points of each major partition.
std::vector<BoundaryVertex> chooseVertices(const Tiling& majors, const std::vector<Point2>& sample)
{
  constexpr int perMajor = 8;
  std::vector<int> taken(static_cast<std::size_t>(majors.size()), 0);
  std::vector<BoundaryVertex> vertices;
  for (const Point2& p : sample)
  {
    const PartitionIndex major = majors.locate(p);
    if (taken[std::size_t(major)]++ < perMajor)
    {
      vertices.push_back({ p, std::int64_t(vertices.size()), major });
    }
  }
  return vertices;
}

/// Distributes `ranks` ranks in proportion to the weights, at least one each: largest remainders.
std::vector<std::size_t> groupSizes(const std::vector<double>& weights, std::size_t ranks)
{
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<std::size_t> sizes(weights.size(), 1);
  std::size_t left = ranks - weights.size();
  while (left > 0)
  {
    std::size_t neediest = 0;
    double most = -1e300;
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      const double missing = weights[i] / total * double(ranks) - double(sizes[i]);
      if (missing > most)
      {
        most = missing;
        neediest = i;
      }
    }
    ++sizes[neediest];
    --left;
  }
  return sizes;
}

} // namespace

std::vector<std::vector<PartitionIndex>> predictStages(const Tiling& majors,
  const std::vector<Point2>& sample, const std::vector<std::int64_t>& majorCounts)
{
  std::vector<BoundaryVertex> vertices = chooseVertices(majors, sample);
  const std::vector<BoundaryVertex> artificial = makeArtificialPoints(majors);
  vertices.insert(vertices.end(), artificial.begin(), artificial.end());
  std::vector<char> withPoints;
  withPoints.reserve(majorCounts.size());
  for (const std::int64_t count : majorCounts)
  {
    withPoints.push_back(count > 0);
  }
  const PartitionOrder order(withPoints, triangulateVertices(majors, vertices, 1));
  std::vector<std::vector<PartitionIndex>> stages(order.colourCount());
  for (const PartitionIndex p : order.sequence())
  {
    stages[order.colourOf(p)].push_back(p);
  }
  // Major partitions without points have colours as well.
  stages.erase(std::remove_if(stages.begin(), stages.end(),
                 [](const std::vector<PartitionIndex>& stage) { return stage.empty(); }),
    stages.end());
  return stages;
}

void formGroups(const std::vector<PartitionIndex>& active,
  const std::vector<std::int64_t>& majorCounts, const Ranks& ranks,
  const DistributedOptions& options, std::vector<double> load, std::vector<Ranks>& groups)
{
  const bool equal = options.Groups == GroupSizes::Equal;
  const auto count = [&](PartitionIndex p) { return double(majorCounts[std::size_t(p)]); };
  std::vector<PartitionIndex> stage = active;
  std::sort(stage.begin(), stage.end());
  if (!equal)
  {
    std::stable_sort(stage.begin(), stage.end(),
      [&](PartitionIndex a, PartitionIndex b) { return count(a) > count(b); });
  }
  if (stage.size() >= ranks.size())
  {
    for (std::size_t i = 0; i < stage.size(); ++i)
    {
      const std::size_t rank = equal
        ? i * ranks.size() / stage.size()
        : std::size_t(std::min_element(load.begin(), load.end()) - load.begin());
      groups[std::size_t(stage[i])] = { ranks[rank] };
      load[rank] += count(stage[i]);
    }
    return;
  }
  std::vector<double> weights;
  weights.reserve(stage.size());
  for (const PartitionIndex p : stage)
  {
    weights.push_back(equal ? 1.0 : count(p));
  }
  const std::vector<std::size_t> sizes = groupSizes(weights, ranks.size());
  auto next = ranks.begin();
  for (std::size_t i = 0; i < stage.size(); ++i)
  {
    const auto end = next + std::ptrdiff_t(sizes[i]);
    groups[std::size_t(stage[i])].assign(next, end);
    next = end;
  }
}

} // namespace tipp
