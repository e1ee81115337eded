// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/Regions.h"

#include "Kernel/Extent.h"
#include "Parallel/ParallelFor.h"

namespace tipp
{

template <typename Id>
Regions::Regions(const Tiling& tiling, const PointBuckets<Id>& buckets, int threads)
  : Tiles(tiling)
  , Boxes(std::size_t(tiling.size()))
  , Used(std::size_t(tiling.size()), 0)
{
  const auto measure = [&](std::int64_t i)
  {
    const auto p = static_cast<PartitionIndex>(i);
    const Extent extent = extentOf(buckets.points(p), buckets.count(p));
    this->Boxes[std::size_t(i)] = { extent.Low[0], extent.Low[1], extent.High[0], extent.High[1] };
    this->Used[std::size_t(i)] = buckets.count(p) > 0;
  };
  parallelFor(tiling.size(), threads, measure);
}

template Regions::Regions(const Tiling&, const PointBuckets<std::int32_t>&, int);
template Regions::Regions(const Tiling&, const PointBuckets<std::int64_t>&, int);

} // namespace tipp
