// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PointBuckets.h"

#include "Kernel/Extent.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation/BucketWriter.h"
#include "Triangulation/PartitionFinder.h"
#include "Triangulation/PopulatePages.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tipp
{
namespace
{

/// The range [begin, end) of n items that is share `part` of `parts` equal shares.
std::pair<std::size_t, std::size_t> share(std::size_t n, int part, int parts)
{
  return { n / std::size_t(parts) * std::size_t(part) +
      std::min(n % std::size_t(parts), std::size_t(part)),
    n / std::size_t(parts) * std::size_t(part + 1) +
      std::min(n % std::size_t(parts), std::size_t(part + 1)) };
}

struct PartSurvey
{
  Box2 Bounds{ HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  std::vector<std::int64_t> Rejected;

  void add(std::size_t first, const Point2* points, std::size_t count)
  {
    const Extent extent = extentOf(points, count);
    if (extent.AllFinite)
    {
      this->extend(extent);
      return;
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      if (isFinite(points[i]))
      {
        this->extend(extentOf(points + i, 1));
      }
      else
      {
        this->Rejected.push_back(static_cast<std::int64_t>(first + i));
      }
    }
  }

  void extend(const Extent& extent)
  {
    this->Bounds.xmin = std::min(this->Bounds.xmin, extent.Low[0]);
    this->Bounds.ymin = std::min(this->Bounds.ymin, extent.Low[1]);
    this->Bounds.xmax = std::max(this->Bounds.xmax, extent.High[0]);
    this->Bounds.ymax = std::max(this->Bounds.ymax, extent.High[1]);
  }
};

PartSurvey surveyPart(PointsView points, std::size_t begin, std::size_t end)
{
  PartSurvey survey;
  points.forBlocks(begin, end,
    [&survey](std::size_t first, const Point2* block, std::size_t count)
    { survey.add(first, block, count); });
  return survey;
}

} // namespace

PointSurvey surveyPoints(PointsView points, int threads)
{
  std::vector<PartSurvey> parts(static_cast<std::size_t>(threads));
  const auto survey = [&](std::int64_t part)
  {
    const auto [begin, end] = share(points.size(), int(part), threads);
    parts[std::size_t(part)] = surveyPart(points, begin, end);
  };
  parallelFor(threads, threads, survey);
  PointSurvey all;
  all.Bounds = PartSurvey().Bounds;
  for (const PartSurvey& part : parts)
  {
    all.Bounds.xmin = std::min(all.Bounds.xmin, part.Bounds.xmin);
    all.Bounds.ymin = std::min(all.Bounds.ymin, part.Bounds.ymin);
    all.Bounds.xmax = std::max(all.Bounds.xmax, part.Bounds.xmax);
    all.Bounds.ymax = std::max(all.Bounds.ymax, part.Bounds.ymax);
    all.Rejected.insert(all.Rejected.end(), part.Rejected.begin(), part.Rejected.end());
  }
  return all;
}

std::vector<Point2> samplePoints(PointsView points, std::size_t count)
{
  std::vector<Point2> sample;
  sample.reserve(count);
  const double step = std::max(1.0, double(points.size()) / double(count));
  const std::size_t samples = std::min(count, points.size());
  for (std::size_t i = 0; i < samples; ++i)
  {
    const Point2 p = points[static_cast<std::size_t>((double(i) + 0.5) * step)];
    if (isFinite(p))
    {
      sample.push_back(p);
    }
  }
  return sample;
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
  const auto [begin, end] = share(6 * this->size(), part, parts);
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
  std::vector<std::vector<std::size_t>> places(
    static_cast<std::size_t>(threads), std::vector<std::size_t>(partitions, 0));
  const auto labelPart = [&](std::int64_t part)
  {
    const auto [begin, end] = share(points.size(), int(part), threads);
    populatePages(labels.data() + begin, (end - begin) * sizeof(std::uint32_t));
    finder.label(points, begin, end, labels.data(), places[std::size_t(part)]);
  };
  parallelFor(threads, threads, labelPart);

  // From here on: the position of each part's next point within its partition.
  std::vector<std::size_t> starts = { 0 };
  for (std::size_t partition = 0; partition < partitions; ++partition)
  {
    std::size_t sum = 0;
    for (std::vector<std::size_t>& place : places)
    {
      const std::size_t count = place[partition];
      place[partition] = sum;
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
        places[std::size_t(part)][std::size_t(p)] });
    }
    BucketWriter<Id> writer(std::move(toFill));
    const auto [begin, end] = share(points.size(), int(part), threads);
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
    const auto [begin, end] = share(points.size(), int(part), threads);
    buckets.populate(int(part), threads);
    points.forEach(begin, end, [to](std::size_t id, Point2 p) { to[id] = p; });
    std::iota(ids + begin, ids + end, static_cast<Id>(begin));
  };
  parallelFor(threads, threads, copyPart);
  return buckets;
}

template class PointBuckets<std::int32_t>;
template class PointBuckets<std::int64_t>;
template PointBuckets<std::int32_t> bucketPoints(PointsView, const Tiling&, int);
template PointBuckets<std::int64_t> bucketPoints(PointsView, const Tiling&, int);
template PointBuckets<std::int32_t> bucketTogether(PointsView, const Box2&, bool, int);
template PointBuckets<std::int64_t> bucketTogether(PointsView, const Box2&, bool, int);

} // namespace tipp
