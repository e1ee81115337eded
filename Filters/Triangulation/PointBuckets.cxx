// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PointBuckets.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace tipp
{
namespace
{

constexpr std::uint32_t NoPartition = std::numeric_limits<std::uint32_t>::max();

/// The share of n items that is the part's, of so many parts.
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

  void add(std::size_t id, Point2 p)
  {
    if (!isFinite(p))
    {
      this->Rejected.push_back(static_cast<std::int64_t>(id));
      return;
    }
    this->Bounds.xmin = std::min(this->Bounds.xmin, p.x);
    this->Bounds.ymin = std::min(this->Bounds.ymin, p.y);
    this->Bounds.xmax = std::max(this->Bounds.xmax, p.x);
    this->Bounds.ymax = std::max(this->Bounds.ymax, p.y);
  }
};

PartSurvey surveyPart(PointsView points, std::size_t begin, std::size_t end)
{
  PartSurvey survey;
  points.forEach(begin, end, [&survey](std::size_t id, Point2 p) { survey.add(id, p); });
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

namespace
{

/// Finds partitions for many points at a time, so that their searches overlap.
class Labeller
{
public:
  Labeller(const Tiling& tiling, std::uint32_t* labels, std::vector<std::size_t>& counts)
    : Boxes(tiling)
    , Labels(labels)
    , Counts(counts)
  {
  }

  void add(std::size_t id, Point2 p)
  {
    this->Points[this->Size] = p;
    if (++this->Size == this->Points.size())
    {
      this->flush(id + 1);
    }
  }

  /// The last points' ids end at `end`.
  void flush(std::size_t end)
  {
    std::uint32_t* labels = this->Labels + end - this->Size;
    this->Boxes.locate(this->Points.data(), this->Size, labels);
    for (std::size_t i = 0; i < this->Size; ++i)
    {
      labels[i] = isFinite(this->Points[i]) ? labels[i] : NoPartition;
      if (labels[i] != NoPartition)
      {
        ++this->Counts[labels[i]];
      }
    }
    this->Size = 0;
  }

private:
  const Tiling& Boxes;
  std::uint32_t* Labels;
  std::vector<std::size_t>& Counts;
  std::array<Point2, 64> Points;
  std::size_t Size = 0;
};

} // namespace

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
  Buffer<std::uint32_t> labels(points.size());
  std::vector<std::vector<std::size_t>> places(
    static_cast<std::size_t>(threads), std::vector<std::size_t>(partitions, 0));
  const auto labelPart = [&](std::int64_t part)
  {
    const auto [begin, end] = share(points.size(), int(part), threads);
    Labeller labeller(tiling, labels.data(), places[std::size_t(part)]);
    points.forEach(begin, end, [&labeller](std::size_t id, Point2 p) { labeller.add(id, p); });
    labeller.flush(end);
  };
  parallelFor(threads, threads, labelPart);

  // From here on places are those of each part's next point within its partition.
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
    struct Cursor
    {
      Point2* Point;
      Id* PointId;
    };
    std::vector<Cursor> cursors;
    for (PartitionIndex p = 0; p < tiling.size(); ++p)
    {
      const std::size_t place = places[std::size_t(part)][std::size_t(p)];
      cursors.push_back({ buckets.pointsToFill(p) + place, buckets.idsToFill(p) + place });
    }
    const auto [begin, end] = share(points.size(), int(part), threads);
    points.forEach(begin, end,
      [&](std::size_t id, Point2 p)
      {
        if (labels[id] != NoPartition)
        {
          Cursor& cursor = cursors[labels[id]];
          *cursor.Point++ = p;
          *cursor.PointId++ = static_cast<Id>(id);
        }
      });
  };
  parallelFor(threads, threads, scatterPart);
  return buckets;
}

template class PointBuckets<std::int32_t>;
template class PointBuckets<std::int64_t>;
template PointBuckets<std::int32_t> bucketPoints(PointsView, const Tiling&, int);
template PointBuckets<std::int64_t> bucketPoints(PointsView, const Tiling&, int);

} // namespace tipp
