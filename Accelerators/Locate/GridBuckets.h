// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGridBuckets_h
#define tippGridBuckets_h

#include "Locate/MortonOrder.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Points sorted into the boxes of a regular grid, about two per box. The points of boxes that are
/// consecutive along x are contiguous.
template <int D>
class GridBuckets
{
public:
  /// Sorts the points at(0) ... at(count - 1); non-finite points are left out.
  template <typename At>
  GridBuckets(std::int64_t count, int threads, const At& at)
    : Bounds(boundsOf<D>(count, threads, [&at](std::int64_t i) { return Box<D>::of(at(i)); }))
  {
    this->chooseSides(count);
    std::size_t buckets = 1;
    for (const std::int64_t side : this->Sides)
    {
      buckets *= std::size_t(side);
    }
    this->Starts = SharedCounters(new std::atomic<std::uint32_t>[buckets + 1]());
    const auto forPoints = [&](const auto& work)
    {
      forChunks(count, 1 << 14, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        {
          for (std::int64_t i = begin; i < end; ++i)
          {
            const std::array<double, D> point = at(i);
            Box<D>::of(point).isEmpty() ? void() : work(i, point, this->bucketOf(point));
          }
        });
    };
    const bool isAlone = threads == 1;
    forPoints([&](std::int64_t, const auto&, std::size_t bucket)
      { addOne(this->Starts[bucket + 1], isAlone); });
    std::uint32_t sum = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket)
    {
      this->Starts[bucket].store(sum, std::memory_order_relaxed);
      sum += this->Starts[bucket + 1].load(std::memory_order_relaxed);
    }
    this->Count = sum;
    this->Entries = std::unique_ptr<Entry[]>(new Entry[sum]);
    // Each start is advanced to the end of its box, which is the start of the next.
    forPoints(
      [&](std::int64_t i, const auto& point, std::size_t bucket) {
        this->Entries[addOne(this->Starts[bucket], isAlone)] = { point, std::int32_t(i) };
      });
  }

  std::size_t size() const { return this->Count; }
  const std::array<double, D>& at(std::size_t entry) const { return this->Entries[entry].At; }
  std::int64_t number(std::size_t entry) const { return this->Entries[entry].Number; }

  /// Calls visit(entry, coordinates) for all points in a box, and some near it.
  template <typename Visit>
  void visitNear(const Box<D>& box, const Visit& visit) const
  {
    std::array<std::int64_t, D> low;
    std::array<std::int64_t, D> high;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      if (box.High[axis] < this->Bounds.Low[axis] || this->Bounds.High[axis] < box.Low[axis])
      {
        return;
      }
      low[axis] = this->positionOf(box.Low[axis], axis);
      high[axis] = this->positionOf(box.High[axis], axis);
    }
    std::array<std::int64_t, D> at = low;
    for (bool isInside = true; isInside;)
    {
      const std::size_t first = this->indexOf(at);
      const std::size_t last = first + std::size_t(high[0] - low[0]);
      const std::uint32_t end = this->Starts[last].load(std::memory_order_relaxed);
      for (std::uint32_t entry = first > 0 ? this->Starts[first - 1].load(std::memory_order_relaxed)
                                           : 0;
           entry < end; ++entry)
      {
        visit(entry, this->Entries[entry].At);
      }
      std::size_t axis = 1;
      for (; axis < D && at[axis]++ == high[axis]; ++axis)
      {
        at[axis] = low[axis];
      }
      isInside = axis < D;
    }
  }

private:
  struct Entry
  {
    std::array<double, D> At;
    std::int32_t Number;
  };

  void chooseSides(std::int64_t count)
  {
    constexpr std::int64_t most = D == 2 ? 1 << 14 : 1 << 9;
    double volume = 1;
    std::array<double, D> extents;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      extents[axis] = this->Bounds.High[axis] - this->Bounds.Low[axis];
      volume *= extents[axis];
    }
    const double width = std::pow(volume / std::max(double(count) / 2, 1.0), 1.0 / D);
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      const double wanted = extents[axis] / width; // NaN or infinite if the points are flat
      this->Sides[axis] = wanted >= 1 ? std::int64_t(std::min(wanted, double(most))) : 1;
      this->Scale[axis] = double(this->Sides[axis]) / extents[axis];
    }
  }

  /// Monotonic in the coordinate.
  std::int64_t positionOf(double coordinate, std::size_t axis) const
  {
    const double at = (coordinate - this->Bounds.Low[axis]) * this->Scale[axis];
    return at > 0 ? std::int64_t(std::min(at, double(this->Sides[axis] - 1))) : 0;
  }
  std::size_t indexOf(const std::array<std::int64_t, D>& at) const
  {
    std::int64_t index = 0;
    for (std::size_t axis = D; axis-- > 0;)
    {
      index = index * this->Sides[axis] + at[axis];
    }
    return std::size_t(index);
  }
  std::size_t bucketOf(const std::array<double, D>& point) const
  {
    std::array<std::int64_t, D> at;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      at[axis] = this->positionOf(point[axis], axis);
    }
    return this->indexOf(at);
  }

  Box<D> Bounds;
  std::array<std::int64_t, D> Sides{};
  std::array<double, D> Scale{};
  SharedCounters Starts; ///< in the end, the end of each box
  std::unique_ptr<Entry[]> Entries;
  std::size_t Count = 0;
};

} // namespace tipp

#endif
