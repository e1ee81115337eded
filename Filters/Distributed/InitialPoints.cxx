// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/InitialPoints.h"

#include "Distributed/RankArrays.h"
#include "Triangulation/PartitionSizes.h"

#include <algorithm>

namespace tipp
{
namespace
{

struct Entry
{
  PlainVertex Vertex;
  std::int64_t Area;
};

/// What one rank sends.
template <typename Id>
class Choice
{
public:
  Choice(const Postbox& ranks, const Plan& plan, const OwnedPoints<Id>& points)
    : Work(plan)
    , Points(points)
    , FirstId(points.FirstIds[std::size_t(ranks.rank())])
    , ToRanks(static_cast<std::size_t>(ranks.size()))
  {
  }

  /// At most so many points of a leaf, for an area's mesh.
  void add(PartitionIndex leaf, std::size_t most, std::int32_t area)
  {
    const std::size_t count = this->Points.Buckets.count(leaf);
    const std::size_t chosen = std::min(count, most);
    for (std::size_t i = 0; i < chosen; ++i)
    {
      const std::size_t at = (2 * i + 1) * count / (2 * chosen);
      const std::int64_t id = this->FirstId + std::int64_t(this->Points.Buckets.id(leaf, at));
      this->ToRanks[std::size_t(this->Work.Areas[std::size_t(area)].Lead)].push_back(
        { { this->Points.Buckets.points(leaf)[at], id }, area });
    }
  }

  const std::vector<std::vector<Entry>>& toRanks() const { return this->ToRanks; }

private:
  const Plan& Work;
  const OwnedPoints<Id>& Points;
  const std::int64_t FirstId;
  std::vector<std::vector<Entry>> ToRanks;
};

} // namespace

template <typename Id>
InitialPointsOfAreas gatherInitialPoints(Postbox& ranks, const Plan& plan,
  const OwnedPoints<Id>& points, const std::vector<std::int64_t>& leafCounts,
  const DistributedOptions& options)
{
  const std::size_t wanted =
    std::size_t(options.InitialPointsPerPartition > 0 ? options.InitialPointsPerPartition
                                                      : InitialPointsOfPartition);
  Choice<Id> choice(ranks, plan, points);
  for (std::size_t index = 0; index < plan.Areas.size(); ++index)
  {
    const Area& area = plan.Areas[index];
    if (!area.hasLeaves())
    {
      continue;
    }
    const auto begin = leafCounts.begin() + area.FirstLeaf;
    const std::size_t used =
      std::size_t(std::count_if(begin, begin + area.Inner, [](std::int64_t n) { return n > 0; }));
    // The whole domain's mesh gets so many of each of its partitions.
    std::size_t seen = 0;
    for (PartitionIndex p = 0; p < area.Inner; ++p)
    {
      const PartitionIndex leaf = area.FirstLeaf + p;
      if (leafCounts[std::size_t(leaf)] == 0)
      {
        continue;
      }
      choice.add(leaf, wanted, std::int32_t(index));
      if (index > 0)
      {
        choice.add(leaf, (seen + 1) * wanted / used - seen * wanted / used, 0);
      }
      ++seen;
    }
  }
  InitialPointsOfAreas gathered;
  for (const std::vector<Entry>& entries : swapArrays(ranks, choice.toRanks()))
  {
    for (const Entry& entry : entries)
    {
      gathered[std::int32_t(entry.Area)].push_back(entry.Vertex);
    }
  }
  return gathered;
}

template InitialPointsOfAreas gatherInitialPoints(Postbox&, const Plan&,
  const OwnedPoints<std::int32_t>&, const std::vector<std::int64_t>&, const DistributedOptions&);
template InitialPointsOfAreas gatherInitialPoints(Postbox&, const Plan&,
  const OwnedPoints<std::int64_t>&, const std::vector<std::int64_t>&, const DistributedOptions&);

} // namespace tipp
