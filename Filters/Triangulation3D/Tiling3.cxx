// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/Tiling3.h"

#include "Arrays/Buffer.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

double coordinate(const Point3& p, int axis)
{
  return axis == 0 ? p.x : (axis == 1 ? p.y : p.z);
}

} // namespace

PointBounds::PointBounds()
{
  this->Box.Min.fill(std::numeric_limits<double>::infinity());
  this->Box.Max.fill(-std::numeric_limits<double>::infinity());
}

void PointBounds::include(const Point3& p)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->Box.Min[k] = std::min(this->Box.Min[k], coordinate(p, int(k)));
    this->Box.Max[k] = std::max(this->Box.Max[k], coordinate(p, int(k)));
  }
}

void PointBounds::include(const PointBounds& other)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->Box.Min[k] = std::min(this->Box.Min[k], other.Box.Min[k]);
    this->Box.Max[k] = std::max(this->Box.Max[k], other.Box.Max[k]);
  }
}

PointSurvey3 surveyPoints(const Point3* points, std::size_t count)
{
  PointSurvey3 survey;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double largest =
      std::max({ std::fabs(points[i].x), std::fabs(points[i].y), std::fabs(points[i].z) });
    const double sum = points[i].x + points[i].y + points[i].z;
    // The larger of NaN and a number may be either. The sum tells, but may overflow for finite
    // numbers.
    if (!std::isfinite(sum) && !isFinite(points[i]))
    {
      survey.Rejected.push_back(std::int64_t(i));
    }
    else
    {
      survey.Largest = std::max(survey.Largest, largest);
    }
  }
  return survey;
}

std::vector<Point3> samplePoints(
  const Point3* points, std::size_t count, std::size_t step, double factor)
{
  std::vector<Point3> sample;
  for (std::size_t i = step / 2; i < count; i += step)
  {
    const Point3& p = points[i];
    if (isFinite(p))
    {
      sample.push_back({ p.x * factor, p.y * factor, p.z * factor });
    }
  }
  return sample;
}

bool areExactTimes(const Point3* points, std::size_t count, double factor)
{
  return factor == 1 ||
    std::all_of(points, points + count,
      [factor](const Point3& p) {
        return isExactTimes(p.x, factor) && isExactTimes(p.y, factor) && isExactTimes(p.z, factor);
      });
}

double moderateFactor(double largest)
{
  // Determinants have degree five in the coordinates, and their filters square them.
  constexpr int moderate = 24;
  return moderateFactor(largest, moderate);
}

Tiling3::Tiling3(std::vector<Point3> sample, int count)
  : Tiling3(std::move(sample), PartitionGroups{ 1, std::max(count, 1) })
{
}

Tiling3::Tiling3(std::vector<Point3> sample, const PartitionGroups& groups)
  : Groups(groups)
{
  this->cut(sample.begin(), sample.end(), 0, groups.Count * groups.Each);
}

/// Returns the axis to cut across: for `count` partitions whose sample points have this bounding
/// box.
int Tiling3::axisFor(int count, const Box3& box)
{
  const auto side = [&box](int k) { return box.Max[std::size_t(k)] - box.Min[std::size_t(k)]; };
  int longest = 0;
  for (int k = 1; k < 3; ++k)
  {
    longest = side(k) > side(longest) ? k : longest;
  }
  this->SlabAxis = this->SlabAxis < 0 ? longest : this->SlabAxis;
  const bool isSlab =
    count > this->Groups.Each ? this->Groups.AreSlabs : this->Groups.ArePartitionsSlabs;
  return isSlab ? this->SlabAxis : longest;
}

/// Returns the share of the sample that all partitions with lower numbers get together.
double Tiling3::shareBefore(int partition) const
{
  const double groups = this->Groups.Count;
  const double rest = (1 + this->Groups.FirstLess) / groups;
  const double first = std::max(rest - this->Groups.FirstLess, rest / 2);
  const double before = double(partition) / this->Groups.Each; // groups
  return before <= 1 ? before * first : first + (before - 1) * (1 - first) / (groups - 1);
}

void Tiling3::cut(Iterator begin, Iterator end, int first, int count)
{
  const std::size_t self = this->Nodes.size();
  this->Nodes.emplace_back();
  PointBounds bounds;
  std::for_each(begin, end, [&bounds](const Point3& p) { bounds.include(p); });
  const int axis = this->axisFor(count, bounds.Box);
  const auto below = [axis](const Point3& p, const Point3& q)
  { return coordinate(p, axis) < coordinate(q, axis); };
  const int each = count > this->Groups.Each ? this->Groups.Each : 1;
  const int lower = count / each / 2 * each;
  const double before = this->shareBefore(first);
  const Iterator middle = begin +
    std::ptrdiff_t(double(end - begin) * (this->shareBefore(first + lower) - before) /
      (this->shareBefore(first + count) - before));
  bool canCut = count > 1 && middle != end;
  double at = 0;
  if (canCut)
  {
    std::nth_element(begin, middle, end, below);
    at = coordinate(*middle, axis);
    canCut = at > bounds.Box.Min[std::size_t(axis)];
  }
  if (!canCut)
  {
    this->Nodes[self].Partition = this->Count++;
    this->Firsts.push_back(first);
    return;
  }
  // Points with the cut's coordinate belong to the upper side.
  const Iterator split =
    std::partition(begin, end, [&](const Point3& p) { return coordinate(p, axis) < at; });
  this->cut(begin, split, first, lower);
  this->Nodes[self].Axis = axis;
  this->Nodes[self].Cut = at;
  this->Nodes[self].Upper = this->Nodes.size();
  this->cut(split, end, first + lower, count - lower);
}

PartitionIndex Tiling3::locate(const Point3& p) const
{
  std::size_t node = 0;
  while (this->Nodes[node].Axis >= 0)
  {
    const Node& cut = this->Nodes[node];
    node = coordinate(p, cut.Axis) < cut.Cut ? node + 1 : cut.Upper;
  }
  return this->Nodes[node].Partition;
}

std::vector<Box3> Tiling3::boxes(const Box3& domain) const
{
  std::vector<Box3> boxes(std::size_t(this->Count));
  this->setBoxes(0, domain, boxes);
  return boxes;
}

void Tiling3::setBoxes(std::size_t node, const Box3& box, std::vector<Box3>& boxes) const
{
  const Node& at = this->Nodes[node];
  if (at.Axis < 0)
  {
    boxes[std::size_t(at.Partition)] = box;
    return;
  }
  Box3 lower = box;
  Box3 upper = box;
  lower.Max[std::size_t(at.Axis)] = upper.Min[std::size_t(at.Axis)] = at.Cut;
  this->setBoxes(node + 1, lower, boxes);
  this->setBoxes(at.Upper, upper, boxes);
}

PointBuckets3 bucketPoints(
  const Point3* points, std::size_t count, const Tiling3& tiling, double factor, int threads)
{
  constexpr std::uint16_t none = 0xffff;
  const auto parts = std::size_t(tiling.size());
  const auto shares = std::size_t(threads);
  Buffer<std::uint16_t> owners(count);
  std::vector<std::vector<std::size_t>> next(shares, std::vector<std::size_t>(parts, 0));
  std::vector<std::vector<PointBounds>> bounds(shares, std::vector<PointBounds>(parts));
  const auto begin = [&](std::size_t share) { return count * share / shares; };
  const auto scaled = [factor](const Point3& p) {
    return Point3{ p.x * factor, p.y * factor, p.z * factor };
  };
  parallelFor(threads, threads,
    [&](std::int64_t thread)
    {
      const auto share = std::size_t(thread);
      for (std::size_t i = begin(share); i < begin(share + 1); ++i)
      {
        const Point3 p = scaled(points[i]);
        if (!isFinite(p))
        {
          owners[i] = none;
          continue;
        }
        const auto owner = std::size_t(tiling.locate(p));
        owners[i] = static_cast<std::uint16_t>(owner);
        ++next[share][owner];
        bounds[share][owner].include(p);
      }
    });
  PointBuckets3 buckets;
  std::size_t sum = 0;
  for (std::size_t p = 0; p < parts; ++p)
  {
    buckets.Begins.push_back(sum);
    PointBounds all;
    for (std::size_t share = 0; share < shares; ++share)
    {
      sum += std::exchange(next[share][p], sum);
      all.include(bounds[share][p]);
    }
    buckets.Regions.push_back(all.Box);
  }
  buckets.Begins.push_back(sum);
  buckets.Points.resize(sum);
  buckets.Ids.resize(sum);
  parallelFor(threads, threads,
    [&](std::int64_t thread)
    {
      const auto share = std::size_t(thread);
      for (std::size_t i = begin(share); i < begin(share + 1); ++i)
      {
        if (owners[i] != none)
        {
          const std::size_t at = next[share][owners[i]]++;
          buckets.Points[at] = scaled(points[i]);
          buckets.Ids[at] = static_cast<std::int32_t>(i);
        }
      }
    });
  return buckets;
}

} // namespace tipp
