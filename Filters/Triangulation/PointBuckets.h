// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointBuckets_h
#define tippPointBuckets_h

#include "Triangulation/Buffer.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Tiling.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// What one pass over the points tells.
struct PointSurvey
{
  Box2 Bounds{};                      ///< of the finite points
  std::vector<std::int64_t> Rejected; ///< NaN or infinite coordinates; ascending
};

PointSurvey surveyPoints(PointsView points, int threads);

/// Evenly spaced finite points, about `count`.
std::vector<Point2> samplePoints(PointsView points, std::size_t count);

/// The finite points and their ids, partition by partition, in the input's order within each.
template <typename Id>
struct PointBuckets
{
  Buffer<Point2> Points;
  Buffer<Id> Ids;
  std::vector<std::size_t> Starts; ///< of each partition, and the end

  std::size_t start(PartitionIndex p) const { return this->Starts[std::size_t(p)]; }
  std::size_t count(PartitionIndex p) const
  {
    return this->Starts[std::size_t(p) + 1] - this->Starts[std::size_t(p)];
  }
};

template <typename Id>
PointBuckets<Id> bucketPoints(PointsView points, const Tiling& tiling, int threads);

extern template PointBuckets<std::int32_t> bucketPoints(PointsView, const Tiling&, int);
extern template PointBuckets<std::int64_t> bucketPoints(PointsView, const Tiling&, int);

} // namespace tipp

#endif
