// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PointBuckets.h"

#include "Kernel/Lanes.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation/PopulatePages.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <numeric>

namespace tipp
{
template <typename Id>
Regions::Regions(const Tiling& tiling, const PointBuckets<Id>& buckets, int threads)
  : Tiles(tiling)
  , Boxes(std::size_t(tiling.size()))
  , Used(std::size_t(tiling.size()), 0)
{
  parallelFor(tiling.size(), threads,
    [&](std::int64_t i)
    {
      const auto p = static_cast<PartitionIndex>(i);
      this->Boxes[std::size_t(i)] = extentOf(buckets.points(p), buckets.count(p)).box();
      this->Used[std::size_t(i)] = buckets.count(p) > 0;
    });
}

template <typename Id>
PointBuckets<Id>::PointBuckets(std::vector<std::size_t> starts)
  : Starts(std::move(starts))
  , Memory(6 * this->Starts.back())
{
}

template <typename Id>
PointBuckets<Id>::PointBuckets(
  std::vector<std::size_t> starts, const Point2* points, std::size_t more)
  : Starts(std::move(starts))
  , Elsewhere(points)
  , Memory(6 * this->Starts.back() + 3 * more)
{
}

template <typename Id>
void PointBuckets<Id>::populate(int part, int parts)
{
  const auto [begin, end] = evenShare(6 * this->size(), part, parts);
  populatePages(this->Memory.data() + begin, (end - begin) * sizeof(Id));
}

template <typename Id>
void PointBuckets<Id>::copyIds(PartitionIndex p, std::vector<Id>& ids) const
{
  ids.resize(this->count(p));
  if (this->Elsewhere)
  {
    std::iota(ids.begin(), ids.end(), static_cast<Id>(this->start(p)));
  }
  else
  {
    std::copy_n(this->heldIds(p), ids.size(), ids.data());
  }
}

template <typename Id>
PointBuckets<Id> bucketPoints(PointsView points, const Tiling& tiling, int threads)
{
  const std::size_t partitions = static_cast<std::size_t>(tiling.size());
  const PartitionFinder finder(tiling);
  Buffer<std::uint32_t> labels(points.size());
  // By part of the input and partition: at first the part's number of points there.
  std::vector<std::vector<std::size_t>> nextOf(
    static_cast<std::size_t>(threads), std::vector<std::size_t>(partitions, 0));
  const auto labelPart = [&](std::int64_t part)
  {
    const auto [begin, end] = evenShare(points.size(), int(part), threads);
    populatePages(labels.data() + begin, (end - begin) * sizeof(std::uint32_t));
    finder.label(points, begin, end, labels.data(), nextOf[std::size_t(part)]);
  };
  parallelFor(threads, threads, labelPart);

  // From here on: the position of each part's next point within its partition.
  std::vector<std::size_t> starts = { 0 };
  for (std::size_t partition = 0; partition < partitions; ++partition)
  {
    std::size_t sum = 0;
    for (std::vector<std::size_t>& next : nextOf)
    {
      const std::size_t count = next[partition];
      next[partition] = sum;
      sum += count;
    }
    starts.push_back(starts.back() + sum);
  }

  PointBuckets<Id> buckets(std::move(starts));
  const auto scatterPart = [&](std::int64_t part)
  {
    buckets.populate(int(part), threads);
    std::vector<typename BucketWriter<Id>::Bucket> toFill;
    toFill.reserve(partitions);
    for (PartitionIndex p = 0; p < tiling.size(); ++p)
    {
      toFill.push_back({ buckets.pointsToFill(p), buckets.idsToFill(p),
        nextOf[std::size_t(part)][std::size_t(p)] });
    }
    BucketWriter<Id> writer(std::move(toFill));
    const auto [begin, end] = evenShare(points.size(), int(part), threads);
    points.forEach(begin, end,
      [&](std::size_t id, Point2 p)
      {
        if (labels[id] != PartitionFinder::None)
        {
          writer.append(labels[id], p, static_cast<Id>(id));
        }
      });
    writer.finish();
  };
  parallelFor(threads, threads, scatterPart);
  return buckets;
}

template <typename Id>
PointBuckets<Id> bucketTogether(PointsView points, const Box2& bounds, bool allFinite, int threads)
{
  if (points.contiguous() && allFinite)
  {
    PointBuckets<Id> buckets({ 0, points.size() }, points.contiguous(), 0);
    buckets.populate(0, 1);
    return buckets;
  }
  if (!allFinite)
  {
    return bucketPoints<Id>(points, Tiling::grid(bounds, 1, 1), threads);
  }
  PointBuckets<Id> buckets({ 0, points.size() });
  Point2* const to = buckets.pointsToFill(0);
  Id* const ids = buckets.idsToFill(0);
  const auto copyPart = [&](std::int64_t part)
  {
    const auto [begin, end] = evenShare(points.size(), int(part), threads);
    buckets.populate(int(part), threads);
    points.forEach(begin, end, [to](std::size_t id, Point2 p) { to[id] = p; });
    std::iota(ids + begin, ids + end, static_cast<Id>(begin));
  };
  parallelFor(threads, threads, copyPart);
  return buckets;
}

template Regions::Regions(const Tiling&, const PointBuckets<std::int32_t>&, int);
template Regions::Regions(const Tiling&, const PointBuckets<std::int64_t>&, int);
template class PointBuckets<std::int32_t>;
template class PointBuckets<std::int64_t>;
template PointBuckets<std::int32_t> bucketPoints(PointsView, const Tiling&, int);
template PointBuckets<std::int64_t> bucketPoints(PointsView, const Tiling&, int);
template PointBuckets<std::int32_t> bucketTogether(PointsView, const Box2&, bool, int);
template PointBuckets<std::int64_t> bucketTogether(PointsView, const Box2&, bool, int);

} // namespace tipp
