// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/Plan.h"

#include "Engine/PartitionSchedule.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/InitialMesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

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
  const auto missing = [&](std::size_t i)
  { return weights[i] / total * double(ranks) - double(sizes[i]); };
  for (std::size_t left = ranks - weights.size(); left > 0; --left)
  {
    std::size_t neediest = 0;
    for (std::size_t i = 1; i < weights.size(); ++i)
    {
      neediest = missing(i) > missing(neediest) ? i : neediest;
    }
    ++sizes[neediest];
  }
  return sizes;
}

/// Predicts which major partitions will be active together, from the conflicts in a mesh of the
/// sample, so that points can be sent to their workers before the triangulation begins. Returns the
/// stages, each a set of major partitions with points.
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
  const PartitionOrder order(withPoints, triangulateVertices<2>(majors, vertices, 1));
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

/// Chooses the group of ranks for each major partition of a stage. If a stage has fewer major
/// partitions than ranks, each group has several ranks, in proportion to the points (equation 3.2).
/// Otherwise a group is the one rank with the fewest points so far.
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

bool wantsManyMasters(const DistributedOptions& options)
{
  return options.Design == Masters::Multi ||
    (options.Design == Masters::Auto && options.Major.isGiven());
}

std::int64_t threshold(std::int64_t points, const DistributedOptions& options, int threads)
{
  if (options.Threshold > 0)
  {
    return options.Threshold;
  }
  return std::clamp(
    points / (PartitionsPerThread * threads), FewestPointsInPartition, BestPointsInPartition);
}

int partsFor(double points, std::int64_t perPart)
{
  constexpr double most = MostPartitions;
  return static_cast<int>(std::clamp(std::ceil(points / double(perPart)), 1.0, most));
}

void requireFewLeaves(std::int64_t leaves)
{
  if (leaves > MostPartitions)
  {
    throw std::length_error("All major partitions would have more than " +
      std::to_string(MostPartitions) + " minor ones together; ask for fewer.");
  }
}

/// Divides a box, which contains about `points` points, into partitions.
Tiling divideBox(const Box2& box, std::vector<Point2> sample, double points, std::int64_t perPart,
  const DistributedOptions& options)
{
  if (options.MinorDivision == Division::Grid && options.Minor.isGiven())
  {
    return Tiling::grid(box, options.Minor.Columns, options.Minor.Rows);
  }
  if (options.MinorDivision == Division::Threshold)
  {
    constexpr double most = 4096;
    const int side = int(std::clamp(std::ceil(std::sqrt(points / double(perPart))), 1.0, most));
    return Tiling::grid(box, side, side);
  }
  return Tiling::balanced(box, std::move(sample), partsFor(points, perPart));
}

/// Splits the items into `parts` consecutive shares of nearly equal weight; returns each item's
/// share.
std::vector<std::int32_t> shareOut(const std::vector<double>& weights, std::size_t parts)
{
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<std::int32_t> shares;
  double before = 0;
  for (const double weight : weights)
  {
    const double middle = before + weight / 2;
    const double part = total > 0 ? middle / total * double(parts) : 0;
    shares.push_back(std::min(std::int32_t(part), std::int32_t(parts) - 1));
    before += weight;
  }
  return shares;
}

/// The partitions' weights for distributing them among ranks.
std::vector<double> weightsOf(
  const std::int64_t* begin, const std::int64_t* end, const DistributedOptions& options)
{
  std::vector<double> weights;
  for (const std::int64_t* count = begin; count != end; ++count)
  {
    weights.push_back(options.Groups == GroupSizes::Equal ? 1.0 : double(*count));
  }
  return weights;
}

/// Assigns an area's leaves to a group of ranks. A share is a set of whole leaves; the largest
/// share goes to the rank with the lowest load so far.
void assignLeaves(Plan& plan, Area& area, const std::vector<std::int32_t>& group,
  const std::vector<std::int64_t>& leafCounts, const DistributedOptions& options,
  std::vector<double>& load)
{
  const std::int64_t* counts = leafCounts.data() + area.FirstLeaf;
  const std::vector<double> weights = weightsOf(counts, counts + area.Boxes.size(), options);
  const std::vector<std::int32_t> shareOf = shareOut(weights, group.size());
  std::vector<std::pair<double, std::size_t>> shares;
  for (std::size_t share = 0; share < group.size(); ++share)
  {
    shares.push_back({ 0, share });
  }
  for (std::size_t p = 0; p < weights.size(); ++p)
  {
    shares[std::size_t(shareOf[p])].first -= weights[p];
  }
  std::vector<std::int32_t> idlest = group;
  if (options.Groups != GroupSizes::Equal)
  {
    std::sort(shares.begin(), shares.end()); // largest first
    std::stable_sort(idlest.begin(), idlest.end(),
      [&load](std::int32_t a, std::int32_t b)
      { return load[std::size_t(a)] < load[std::size_t(b)]; });
  }
  std::vector<std::int32_t> rankOf(group.size());
  for (std::size_t i = 0; i < group.size(); ++i)
  {
    rankOf[shares[i].second] = idlest[i];
    load[std::size_t(idlest[i])] -= shares[i].first;
  }
  area.Lead = group.front();
  std::transform(shareOf.begin(), shareOf.end(), plan.Owners.begin() + area.FirstLeaf,
    [&rankOf](std::int32_t share) { return rankOf[std::size_t(share)]; });
}

} // namespace

std::vector<std::int32_t> Plan::masters() const
{
  std::vector<std::int32_t> masters(std::size_t(this->Leaves.size()), this->Areas.front().Lead);
  for (std::size_t a = 1; a < this->Areas.size(); ++a)
  {
    const Area& area = this->Areas[a];
    std::fill_n(masters.begin() + area.FirstLeaf, area.Boxes.size(), area.Lead);
  }
  return masters;
}

std::size_t wantedSample(std::int64_t points, const DistributedOptions& options, int threads)
{
  const std::int64_t perPart = threshold(points, options, threads);
  const std::size_t parts = std::size_t(partsFor(double(points), perPart));
  return SamplesPerPartition *
    std::clamp(std::max(parts, std::size_t(options.Major.isGiven() ? options.Major.size() : 0)),
      std::size_t(16), std::size_t(1) << 16);
}

Plan planAlone(const Box2& domain)
{
  Plan plan;
  plan.Leaves = Tiling::grid(domain, 1, 1);
  plan.Owners = { 0 };
  plan.Areas.push_back({ plan.Leaves });
  return plan;
}

Plan divide(const PlanInput& input, const DistributedOptions& options)
{
  constexpr std::int64_t alone = 4096;
  const bool gridded = options.Major.isGiven() || options.Minor.isGiven() || options.Threshold > 0;
  if (input.Points <= alone && !gridded)
  {
    return planAlone(input.Domain);
  }
  const std::int64_t perPart = threshold(input.Points, options, input.Threads);
  Plan plan;
  if (!wantsManyMasters(options))
  {
    plan.Leaves = divideBox(input.Domain, input.Sample, double(input.Points), perPart, options);
    plan.Areas.push_back({ plan.Leaves });
    return plan.Leaves.size() > 1 ? plan : planAlone(input.Domain);
  }
  constexpr int fewestMajors = 16;
  const Tiling majors = options.Major.isGiven()
    ? Tiling::grid(input.Domain, options.Major.Columns, options.Major.Rows)
    : Tiling::balanced(input.Domain, input.Sample, std::max(fewestMajors, 2 * input.Ranks));
  plan.Areas.push_back({ majors });
  if (options.MinorDivision == Division::Grid)
  {
    requireFewLeaves(majors.size() * std::max<std::int64_t>(1, options.Minor.size()));
  }
  std::vector<std::vector<Point2>> samples(static_cast<std::size_t>(majors.size()));
  for (const Point2& p : input.Sample)
  {
    samples[std::size_t(majors.locate(p))].push_back(p);
  }
  const double pointsPerSample =
    double(input.Points) / double(std::max(input.Sample.size(), std::size_t(1)));
  std::vector<Tiling> inner;
  PartitionIndex leaf = 0;
  for (PartitionIndex p = 0; p < majors.size(); ++p)
  {
    std::vector<Point2>& sample = samples[std::size_t(p)];
    const double points = double(sample.size()) * pointsPerSample;
    inner.push_back(divideBox(majors.box(p), std::move(sample), points, perPart, options));
    requireFewLeaves(std::int64_t(leaf) + inner.back().size());
    plan.Areas.push_back({ inner.back(), leaf });
    leaf += inner.back().size();
  }
  plan.Leaves = majors.refined(inner);
  return plan.Leaves.size() > 1 ? plan : planAlone(input.Domain);
}

void assign(Plan& plan, const PlanInput& input, const std::vector<std::int64_t>& leafCounts,
  const DistributedOptions& options)
{
  plan.Owners.assign(static_cast<std::size_t>(plan.Leaves.size()), 0);
  std::vector<std::int32_t> all(static_cast<std::size_t>(input.Ranks));
  std::iota(all.begin(), all.end(), 0);
  Area& top = plan.Areas.front();
  std::vector<double> load(all.size(), 0);
  if (plan.majors() == 0)
  {
    // With many ranks, the first one is only the master.
    constexpr int masterAlone = 32;
    if (input.Ranks >= masterAlone && !options.isMasterless())
    {
      all.erase(all.begin());
    }
    assignLeaves(plan, top, all, leafCounts, options, load);
    top.Lead = 0;
    return;
  }
  std::vector<std::int64_t> majorCounts;
  for (auto area = plan.Areas.begin() + 1; area != plan.Areas.end(); ++area)
  {
    const auto begin = leafCounts.begin() + area->FirstLeaf;
    majorCounts.push_back(std::accumulate(begin, begin + area->Boxes.size(), std::int64_t(0)));
  }
  std::vector<std::vector<std::int32_t>> groups(majorCounts.size(), { all.front() });
  const auto assignMajor = [&](PartitionIndex p)
  {
    assignLeaves(
      plan, plan.Areas[std::size_t(p) + 1], groups[std::size_t(p)], leafCounts, options, load);
  };
  for (const auto& stage : predictStages(top.Boxes, input.Sample, majorCounts))
  {
    formGroups(stage, majorCounts, all, options, load, groups);
    std::for_each(stage.begin(), stage.end(), assignMajor);
  }
  for (PartitionIndex p = 0; p < plan.majors(); ++p)
  {
    if (majorCounts[std::size_t(p)] == 0) // it is in no stage
    {
      assignMajor(p);
    }
  }
}

} // namespace tipp
