// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/Partitions3.h"
#include "Triangulation/InitialMesh.h"

#include "Arrays/Buffer.h"
#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"

#include <algorithm>
#include <utility>

namespace tipp
{

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
  int longest = 0;
  for (int k = 1; k < 3; ++k)
  {
    longest = box.width(k) > box.width(longest) ? k : longest;
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

/// Returns the node.
std::int32_t Tiling3::cut(Iterator begin, Iterator end, int first, int count)
{
  Box3 bounds = Box3::empty();
  std::for_each(begin, end, [&bounds](const Point3& p) { bounds.extend(p); });
  const int axis = this->axisFor(count, bounds);
  const auto k = std::size_t(axis);
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
    std::nth_element(
      begin, middle, end, [k](const Point3& p, const Point3& q) { return p[k] < q[k]; });
    at = (*middle)[k];
    canCut = at > bounds.Min[k];
  }
  if (!canCut)
  {
    this->Firsts.push_back(first);
    return this->addLeaf(this->size());
  }
  const Iterator split = std::partition(begin, end, [&](const Point3& p) { return p[k] < at; });
  return this->addCut(
    axis, at, [&] { return this->cut(begin, split, first, lower); },
    [&] { return this->cut(split, end, first + lower, count - lower); });
}

std::vector<Box3> Tiling3::boxes(const Box3& domain) const
{
  std::vector<Box3> boxes(std::size_t(this->size()));
  this->setBoxes(this->node(0), domain, boxes);
  return boxes;
}

void Tiling3::setBoxes(const Node& node, const Box3& box, std::vector<Box3>& boxes) const
{
  if (node.isBox())
  {
    boxes[std::size_t(node.Partition)] = box;
    return;
  }
  const auto [lower, upper] = box.cut(std::size_t(node.Axis), node.Coordinate);
  this->setBoxes(this->node(node.Child[0]), lower, boxes);
  this->setBoxes(this->node(node.Child[1]), upper, boxes);
}

PointBuckets3 bucketPoints(const PointsView3& points, const Tiling3& tiling, int threads)
{
  constexpr std::uint16_t none = 0xffff;
  const auto parts = std::size_t(tiling.size());
  const auto shares = std::size_t(threads);
  Buffer<std::uint16_t> owners(points.size());
  std::vector<std::vector<std::size_t>> next(shares, std::vector<std::size_t>(parts, 0));
  std::vector<std::vector<Box3>> bounds(shares, std::vector<Box3>(parts, Box3::empty()));
  parallelFor(threads, threads,
    [&](std::int64_t thread)
    {
      const auto share = std::size_t(thread);
      const auto [begin, end] = evenShare(points.size(), int(thread), threads);
      points.forEach(begin, end,
        [&](std::size_t i, const Point3& p)
        {
          owners[i] = none;
          if (isFinite(p))
          {
            const auto owner = std::size_t(tiling.locate(p));
            owners[i] = static_cast<std::uint16_t>(owner);
            ++next[share][owner];
            bounds[share][owner].extend(p);
          }
        });
    });
  PointBuckets3 buckets;
  for (std::size_t p = 0; p < parts; ++p)
  {
    Box3 all = Box3::empty();
    for (const std::vector<Box3>& ofShare : bounds)
    {
      all.extend(ofShare[p]);
    }
    buckets.Regions.push_back(all);
  }
  buckets.Begins = countsToIndices(parts, next);
  buckets.Points.resize(buckets.Begins.back());
  buckets.Ids.resize(buckets.Begins.back());
  parallelFor(threads, threads,
    [&](std::int64_t thread)
    {
      const auto [begin, end] = evenShare(points.size(), int(thread), threads);
      points.forEach(begin, end,
        [&, share = std::size_t(thread)](std::size_t i, const Point3& p)
        {
          if (owners[i] != none)
          {
            const std::size_t at = next[share][owners[i]]++;
            buckets.Points[at] = p;
            buckets.Ids[at] = static_cast<std::int32_t>(i);
          }
        });
    });
  return buckets;
}

std::vector<std::size_t> chooseInitialPoints(
  const Point3* points, std::size_t count, std::size_t wanted)
{
  std::vector<std::size_t> chosen;
  const auto add = [&](const auto& isBefore)
  { chosen.push_back(std::size_t(std::min_element(points, points + count, isBefore) - points)); };
  for (double Point3::*axis : { &Point3::x, &Point3::y, &Point3::z })
  {
    add([axis](const Point3& a, const Point3& b) { return a.*axis < b.*axis; });
    add([axis](const Point3& a, const Point3& b) { return a.*axis > b.*axis; });
  }
  for (std::size_t i = 0; i < wanted; ++i)
  {
    chosen.push_back((2 * i + 1) * count / (2 * wanted));
  }
  sortUnique(chosen);
  return chosen;
}

std::vector<Vertex3> makeArtificialPoints(const PointBuckets3& buckets, bool areSlabs)
{
  const std::vector<char> areUsed = buckets.areUsed();
  Box3 domain = Box3::empty();
  double margin = 0;
  std::size_t used = 0;
  for (std::size_t p = 0; p < buckets.Regions.size(); ++p)
  {
    if (areUsed[p])
    {
      const Box3& box = buckets.Regions[p];
      domain.extend(box);
      const std::initializer_list<double> sides = { box.width(0), box.width(1), box.width(2) };
      margin += areSlabs ? std::min(sides) / 2 : std::max(sides);
      ++used;
    }
  }
  margin /= double(std::max<std::size_t>(used, 1));
  std::array<std::vector<double>, 3> ticks;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double low = outward(domain.Min[k], -1, margin);
    const double high = outward(domain.Max[k], 1, margin);
    constexpr double most = 16;
    if (!std::isfinite(high - low))
    {
      return {};
    }
    const auto pieces = int(std::clamp(std::ceil((high - low) / margin), 1.0, most));
    for (int i = 0; i < pieces; ++i)
    {
      ticks[k].push_back(low + (high - low) * (double(i) / pieces));
    }
    ticks[k].push_back(high);
  }
  std::vector<Vertex3> vertices;
  for (const double x : ticks[0])
  {
    for (const double y : ticks[1])
    {
      for (const double z : ticks[2])
      {
        const auto isEnd = [](double at, const std::vector<double>& all)
        { return at == all.front() || at == all.back(); };
        if (isEnd(x, ticks[0]) || isEnd(y, ticks[1]) || isEnd(z, ticks[2]))
        {
          vertices.push_back({ { x, y, z }, -1 - std::int64_t(vertices.size()), -1 });
        }
      }
    }
  }
  return vertices;
}

BoundaryCells<3> makeInitialMesh(const Tiling3& tiling, const PointBuckets3& buckets,
  const std::vector<Vertex3>& artificial, std::size_t wanted)
{
  std::vector<Vertex3> vertices;
  for (PartitionIndex p = 0; p < tiling.size(); ++p)
  {
    const PartitionPoints3 own = buckets.of(p);
    for (const std::size_t i : own.Count > 0 ? chooseInitialPoints(own.Points, own.Count, wanted)
                                             : std::vector<std::size_t>())
    {
      vertices.push_back({ own.Points[i], own.id(i), p });
    }
  }
  vertices.insert(vertices.end(), artificial.begin(), artificial.end());
  return triangulateVertices<3>(buckets.regions(tiling), vertices, 1);
}

} // namespace tipp
