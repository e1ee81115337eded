// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointsInBox_h
#define tippPointsInBox_h

#include "Arrays/Buffer.h"
#include "Locate/MortonOrder.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Points row by row, as the centres of a raster's pixels: those with each of some x and each of
/// some y, and in space z. Along an axis the coordinates rise or fall; their steps may differ, and
/// any axis may be the fastest. So the points in a box are found without sorting, or even reading,
/// them.
template <int D>
class PointRows
{
public:
  /// Empty if the points at(0) ... at(count - 1) are anything else.
  template <typename At>
  PointRows(std::int64_t count, int threads, const At& at)
  {
    if (!this->findSteps(count, at) || !this->areRows(count, threads, at))
    {
      return;
    }
    this->Count = std::size_t(count);
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      std::vector<double>& values = this->Axes[axis].Values;
      if (values.front() > values.back())
      {
        std::reverse(values.begin(), values.end());
        this->First += (std::int64_t(values.size()) - 1) * this->Axes[axis].Step;
        this->Axes[axis].Step = -this->Axes[axis].Step;
      }
      const double extent = values.back() - values.front();
      this->Axes[axis].Scale = extent > 0 ? double(values.size() - 1) / extent : 0;
    }
  }

  std::size_t size() const { return this->Count; }
  std::int64_t number(std::size_t entry) const { return std::int64_t(entry); }
  Point<D> at(std::size_t entry) const
  {
    Point<D> point;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      const Axis& of = this->Axes[axis];
      const auto index = std::size_t(std::int64_t(entry) / std::abs(of.Step)) % of.Values.size();
      point[axis] = of.Values[of.Step > 0 ? index : of.Values.size() - 1 - index];
    }
    return point;
  }

  /// Calls visit(entry, point) for all points in a closed box.
  template <typename Visit>
  void visitNear(const Box<D>& box, const Visit& visit) const
  {
    std::array<std::int64_t, D> begin;
    std::array<std::int64_t, D> end;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      begin[axis] = this->Axes[axis].firstFrom(box.Min[axis]);
      end[axis] = this->Axes[axis].firstBeyond(box.Max[axis], begin[axis]);
      if (begin[axis] == end[axis])
      {
        return;
      }
    }
    if constexpr (D == 3)
    {
      if (this->Fastest == 2)
      {
        this->visitRows<2>(begin, end, visit);
        return;
      }
    }
    this->Fastest == 0 ? this->visitRows<0>(begin, end, visit)
                       : this->visitRows<1>(begin, end, visit);
  }

private:
  struct Axis
  {
    std::vector<double> Values; ///< ascending
    std::int64_t Step = 1;      ///< distance between the entries of successive values
    double Scale = 0;           ///< about the number of values per unit of length

    /// The index of the first value that is not lower.
    std::int64_t firstFrom(double value) const
    {
      const auto count = std::int64_t(this->Values.size());
      const double guess = (value - this->Values[0]) * this->Scale;
      std::int64_t i = guess > 0 ? std::int64_t(std::min(guess, double(count - 1))) : 0;
      constexpr int most = 4;
      for (int moved = 0; moved < most; ++moved)
      {
        if (i > 0 && this->Values[std::size_t(i - 1)] >= value)
        {
          --i;
        }
        else if (i < count && this->Values[std::size_t(i)] < value)
        {
          ++i;
        }
        else
        {
          return i;
        }
      }
      return std::lower_bound(this->Values.begin(), this->Values.end(), value) -
        this->Values.begin();
    }

    /// The index of the first value that is higher, from `begin` on.
    std::int64_t firstBeyond(double value, std::int64_t begin) const
    {
      const auto count = std::int64_t(this->Values.size());
      constexpr std::int64_t most = 8;
      for (std::int64_t i = begin; i < std::min(begin + most, count); ++i)
      {
        if (this->Values[std::size_t(i)] > value)
        {
          return i;
        }
      }
      return std::upper_bound(this->Values.begin() + begin, this->Values.end(), value) -
        this->Values.begin();
    }
  };

  /// Calls visit(entry, point) for the indices [begin, end) along each axis.
  template <std::size_t Fast, typename Visit>
  void visitRows(const std::array<std::int64_t, D>& begin, const std::array<std::int64_t, D>& end,
    const Visit& visit) const
  {
    const Axis& along = this->Axes[Fast];
    std::array<std::int64_t, D> index = begin;
    for (bool isInside = true; isInside;)
    {
      std::int64_t entry = this->First;
      Point<D> point;
      for (std::size_t axis = 0; axis < D; ++axis)
      {
        entry += index[axis] * this->Axes[axis].Step;
        point[axis] = this->Axes[axis].Values[std::size_t(index[axis])];
      }
      for (std::int64_t i = begin[Fast]; i < end[Fast]; ++i, entry += along.Step)
      {
        point[Fast] = along.Values[std::size_t(i)];
        visit(std::uint32_t(entry), point);
      }
      isInside = false;
      for (std::size_t axis = 0; axis < D && !isInside; ++axis)
      {
        isInside = axis != Fast && ++index[axis] < end[axis];
        index[axis] = isInside || axis == Fast ? index[axis] : begin[axis];
      }
    }
  }

  /// 0 and -0 differ: they may give weights of different signs.
  static bool isSame(double a, double b) { return a == b && std::signbit(a) == std::signbit(b); }

  /// Reads the values of each axis where the others have their first one; false if they do not
  /// multiply up to the number of points.
  template <typename At>
  bool findSteps(std::int64_t count, const At& at)
  {
    if (count < 2)
    {
      return false;
    }
    std::array<std::size_t, D> order; // the fastest axis first
    const auto first = at(0);
    std::int64_t step = 1;
    std::array<bool, D> isDone{};
    for (std::size_t k = 0; k < D; ++k)
    {
      // The next axis is the one that changes at the next step.
      std::size_t next = D;
      for (std::size_t axis = 0; axis < D; ++axis)
      {
        const bool changes = step < count && !isSame(at(step)[axis], first[axis]);
        if (!isDone[axis] && (next == D || changes))
        {
          next = axis;
        }
      }
      order[k] = next;
      isDone[next] = true;
      Axis& axis = this->Axes[next];
      axis.Step = step;
      bool isRising = false;
      for (std::int64_t i = 0; i < count; i += step)
      {
        const auto point = at(i);
        bool goesOn = std::isfinite(point[next]);
        for (std::size_t other = 0; other < D; ++other)
        {
          goesOn = goesOn && (other == next || isSame(point[other], first[other]));
        }
        if (i == step)
        {
          isRising = point[next] > first[next];
        }
        if (!goesOn ||
          (i > 0 &&
            !(isRising ? point[next] > axis.Values.back() : point[next] < axis.Values.back())))
        {
          break;
        }
        axis.Values.push_back(point[next]);
      }
      if (axis.Values.empty())
      {
        return false;
      }
      step *= std::int64_t(axis.Values.size());
    }
    this->Fastest = order[0];
    return step == count;
  }

  template <typename At>
  bool areRows(std::int64_t count, int threads, const At& at) const
  {
    std::atomic<bool> are{ true };
    forChunks(count, 1 << 14, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        std::array<std::size_t, D> index; // of the point's coordinate in Values, per axis
        std::array<std::int64_t, D> left; // points until the value changes
        for (std::size_t axis = 0; axis < D; ++axis)
        {
          const Axis& of = this->Axes[axis];
          index[axis] = std::size_t(begin / of.Step) % of.Values.size();
          left[axis] = of.Step - begin % of.Step;
        }
        bool areHere = are;
        for (std::int64_t i = begin; i < end && areHere; ++i)
        {
          const auto point = at(i);
          for (std::size_t axis = 0; axis < D; ++axis)
          {
            const Axis& of = this->Axes[axis];
            areHere = areHere && isSame(point[axis], of.Values[index[axis]]);
            if (--left[axis] == 0)
            {
              left[axis] = of.Step;
              index[axis] = index[axis] + 1 < of.Values.size() ? index[axis] + 1 : 0;
            }
          }
        }
        if (!areHere)
        {
          are.store(false);
        }
      });
    return are;
  }

  std::array<Axis, D> Axes;
  std::size_t Fastest = 0;
  std::int64_t First = 0; ///< the entry with the lowest value of each axis
  std::size_t Count = 0;
};

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
    this->sort(count, threads, at);
  }

  std::size_t size() const { return this->Starts.back(); }
  const Point<D>& at(std::size_t entry) const { return this->Entries[entry].Position; }
  std::int64_t number(std::size_t entry) const { return this->Entries[entry].Number; }

  /// Calls visit(entry, point) for all points in a box, and some near it.
  template <typename Visit>
  void visitNear(const Box<D>& box, const Visit& visit) const
  {
    std::array<std::int64_t, D> low;
    std::array<std::int64_t, D> high;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      if (box.Max[axis] < this->Bounds.Min[axis] || this->Bounds.Max[axis] < box.Min[axis])
      {
        return;
      }
      low[axis] = this->positionOf(box.Min[axis], axis);
      high[axis] = this->positionOf(box.Max[axis], axis);
    }
    std::array<std::int64_t, D> at = low;
    for (bool isInside = true; isInside;)
    {
      const std::size_t first = this->indexOf(at);
      const std::size_t last = first + std::size_t(high[0] - low[0]);
      for (std::uint32_t entry = this->Starts[first]; entry < this->Starts[last + 1]; ++entry)
      {
        visit(entry, this->Entries[entry].Position);
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
  struct NumberedPoint
  {
    Point<D> Position;
    std::int32_t Number;
  };

  /// Sorts words of a point's bucket and number. The words of points that are not finite end up
  /// last, and are dropped.
  template <typename At>
  void sort(std::int64_t count, int threads, const At& at)
  {
    const std::uint64_t none = this->buckets();
    const unsigned shift = unsigned(__builtin_clzll(none)); // few digits to sort by
    std::vector<std::uint64_t> words(static_cast<std::size_t>(count));
    forIndices(
      count,
      [&](std::int64_t i)
      {
        const Point<D> point = at(i);
        const std::uint64_t bucket = isFinite(point) ? this->bucketOf(point) : none;
        words[std::size_t(i)] = bucket << shift | std::uint64_t(i);
      },
      threads);
    sortByUpperHalf(words, threadCount(threads), shift);
    words.erase(std::lower_bound(words.begin(), words.end(), none << shift), words.end());
    const auto bucketAt = [&](std::int64_t entry)
    { return entry < std::int64_t(words.size()) ? words[std::size_t(entry)] >> shift : none; };
    this->Entries = Buffer<NumberedPoint>(words.size());
    this->Starts.resize(std::size_t(none) + 1);
    forIndices(
      std::int64_t(words.size()) + 1,
      [&](std::int64_t entry)
      {
        // The buckets after the one before, which may be empty, begin here.
        for (std::uint64_t b = entry == 0 ? 0 : bucketAt(entry - 1) + 1; b <= bucketAt(entry); ++b)
        {
          this->Starts[std::size_t(b)] = std::uint32_t(entry);
        }
        if (entry < std::int64_t(words.size()))
        {
          const auto number =
            std::int64_t(words[std::size_t(entry)] & ((std::uint64_t(1) << shift) - 1));
          this->Entries.data()[entry] = { at(number), std::int32_t(number) };
        }
      },
      threads);
  }

  std::size_t buckets() const
  {
    std::size_t buckets = 1;
    for (const std::int64_t side : this->Sides)
    {
      buckets *= std::size_t(side);
    }
    return buckets;
  }

  void chooseSides(std::int64_t count)
  {
    constexpr std::int64_t most = D == 2 ? 1 << 14 : 1 << 9;
    double volume = 1;
    std::array<double, D> extents;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      extents[axis] = this->Bounds.width(axis);
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
    const double at = (coordinate - this->Bounds.Min[axis]) * this->Scale[axis];
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
  std::size_t bucketOf(const Point<D>& point) const
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
  std::vector<std::uint32_t> Starts; ///< by bucket, and the number of points
  Buffer<NumberedPoint> Entries;     ///< by bucket
};

} // namespace tipp

#endif
