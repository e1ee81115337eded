// SPDX-License-Identifier: BSD-3-Clause
#include "Locate/CellPass.h"

#include "Locate/CellChoice.h"
#include "Locate/Locations.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Points sorted into the boxes of a regular grid, about two per box. The points of boxes that are
/// consecutive along x are contiguous.
template <int D>
class PointBuckets
{
public:
  struct Entry
  {
    std::array<double, D> At;
    std::int32_t Number;
  };

  /// Sorts the points at(0) ... at(count - 1); non-finite points are left out.
  template <typename At>
  PointBuckets(std::int64_t count, int threads, const At& at)
    : Bounds(boundsOf<D>(count, threads, [&at](std::int64_t i) { return Box<D>::of(at(i)); }))
  {
    this->chooseSides(count);
    std::size_t buckets = 1;
    for (const std::int64_t side : this->Sides)
    {
      buckets *= std::size_t(side);
    }
    this->Starts = Counters(new std::atomic<std::uint32_t>[buckets + 1]());
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
      { next(this->Starts[bucket + 1], isAlone); });
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
        this->Entries[next(this->Starts[bucket], isAlone)] = { point, std::int32_t(i) };
      });
  }

  std::size_t size() const { return this->Count; }
  const Entry& operator[](std::size_t i) const { return this->Entries[i]; }

  /// Calls visit(first, last) for ranges [first, last) of entries; together they hold all points in
  /// a box, and others.
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
      visit(first > 0 ? this->Starts[first - 1].load(std::memory_order_relaxed) : 0,
        this->Starts[last].load(std::memory_order_relaxed));
      std::size_t axis = 1;
      for (; axis < D && at[axis]++ == high[axis]; ++axis)
      {
        at[axis] = low[axis];
      }
      isInside = axis < D;
    }
  }

private:
  using Counters = std::unique_ptr<std::atomic<std::uint32_t>[]>;

  /// Increments a counter and returns its previous value. A single thread avoids the locked
  /// instruction.
  static std::uint32_t next(std::atomic<std::uint32_t>& counter, bool isAlone)
  {
    if (!isAlone)
    {
      return counter.fetch_add(1, std::memory_order_relaxed);
    }
    const std::uint32_t before = counter.load(std::memory_order_relaxed);
    counter.store(before + 1, std::memory_order_relaxed);
    return before;
  }

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
  Counters Starts; ///< in the end, the end of each box
  std::unique_ptr<Entry[]> Entries;
  std::size_t Count = 0;
};

enum class Side
{
  Outside,
  Border,
  Inside
};

/// On which side of a closed cell's border a point lies. Exact. Degenerate cells contain no point.
Side sideOf(const Point2 (&corners)[3], Point2 p)
{
  const int first = orientation(corners[0], corners[1], p);
  const int second = orientation(corners[1], corners[2], p);
  if (first * second < 0)
  {
    return Side::Outside;
  }
  const int sum = first + second + orientation(corners[2], corners[0], p);
  return sum == 3 || sum == -3 ? Side::Inside : contains(corners, p) ? Side::Border : Side::Outside;
}

Side sideOf(const Point3 (&corners)[4], const Point3& p)
{
  const auto& [a, b, c, d] = corners;
  const int sides[4] = { orientation3(a, b, c, p), orientation3(a, c, d, p),
    orientation3(a, d, b, p), orientation3(b, d, c, p) };
  const int sum = sides[0] + sides[1] + sides[2] + sides[3];
  return sum == 4 || sum == -4 ? Side::Inside : contains(corners, p) ? Side::Border : Side::Outside;
}

Point2 pointAt(const std::array<double, 2>& at)
{
  return { at[0], at[1] };
}
Point3 pointAt(const std::array<double, 3>& at)
{
  return { at[0], at[1], at[2] };
}

/// Decides quickly for most points whether they lie in a cell.
class TriangleFilter
{
public:
  TriangleFilter(const Point2 (&corners)[3], const Box<2>& box)
    : Around(box)
    , A(corners[0])
    , B(corners[1])
    , C(corners[2])
  {
    const double area = (this->B.x - this->A.x) * (this->C.y - this->A.y) -
      (this->B.y - this->A.y) * (this->C.x - this->A.x);
    area < 0 ? std::swap(this->B, this->C) : void();
    // The error bound of orientation(), with the box's extents as the largest factors, plus a
    // margin for the rounding of the area, whose sign is used. Infinite after an overflow.
    constexpr double relative = 3.3306690738754716e-16;
    this->Bound = 8 * relative * (box.High[0] - box.Low[0]) * (box.High[1] - box.Low[1]) + 1e-300;
  }

  /// True only if the point is outside.
  bool isOutside(const std::array<double, 2>& at) const
  {
    // Branch-free. NaN, after an overflow, does not count as outside.
    const bool isApart = (at[0] < this->Around.Low[0]) | (at[0] > this->Around.High[0]) |
      (at[1] < this->Around.Low[1]) | (at[1] > this->Around.High[1]);
    return isApart | (this->lowest(at) < -this->Bound);
  }
  /// True only if the point of the box is strictly inside.
  bool isInside(const std::array<double, 2>& at) const { return this->lowest(at) > this->Bound; }

private:
  /// The lowest of the three orientations.
  double lowest(const std::array<double, 2>& at) const
  {
    const double ax = this->A.x - at[0];
    const double ay = this->A.y - at[1];
    const double bx = this->B.x - at[0];
    const double by = this->B.y - at[1];
    const double cx = this->C.x - at[0];
    const double cy = this->C.y - at[1];
    const double ab = ax * by - ay * bx;
    const double bc = bx * cy - by * cx;
    const double ca = cx * ay - cy * ax;
    const double first = ab < bc ? ab : bc;
    // If one of them is NaN, so is their sum.
    return std::isfinite(ab + bc + ca) ? (first < ca ? first : ca)
                                       : std::numeric_limits<double>::quiet_NaN();
  }

  const Box<2>& Around;
  Point2 A;
  Point2 B;
  Point2 C;
  double Bound;
};

/// In space a box is enough.
class BoxFilter
{
public:
  BoxFilter(const Point3 (&)[4], const Box<3>& box)
    : Around(box)
  {
  }
  bool isOutside(const std::array<double, 3>& at) const { return !this->Around.holds(at); }
  bool isInside(const std::array<double, 3>&) const { return false; }

private:
  const Box<3>& Around;
};

/// The pass over the cells of a mesh.
template <typename Access>
class Pass
{
public:
  static constexpr int D = Access::Dimension;
  using Point = decltype(pointAt(std::array<double, D>()));

  Pass(const Access& access, const SimplexMesh& mesh, const std::int64_t* cellIds,
    const AskedPoints& points, int threads, const TakeLocations& take)
    : Cells(access)
    , Mesh(mesh)
    , CellIds(cellIds)
    , Points(points)
    , Threads(threads)
    , Take(take)
    , Buckets(points.Count, threads,
        [&](std::int64_t i) { return arrayOf(flattened<D>(mesh, points.at(i))); })
    , Claims(new std::atomic<std::int32_t>[this->Buckets.size()])
    , MostTests(testsPerItem * (mesh.Cells + points.Count))
    , MostDoubts(8 * std::size_t(points.Count) + 1024)
  {
    forChunks(std::int64_t(this->Buckets.size()), 1 << 16, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          this->Claims[std::size_t(i)].store(-1, std::memory_order_relaxed);
        }
      });
  }

  bool run()
  {
    forChunks(this->Mesh.Cells, 1 << 12, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      { this->IsTooMuch ? void() : this->addCells(begin, end); });
    if (!this->IsTooMuch)
    {
      this->settleDoubts();
    }
    return !this->IsTooMuch;
  }

private:
  static constexpr std::int64_t testsPerItem = 32;

  /// A cell that may not be the only one to contain a point.
  struct Doubt
  {
    std::uint32_t Entry;
    std::int32_t Cell;
  };

  void addCells(std::int64_t begin, std::int64_t end)
  {
    Locations locations(this->Take);
    std::vector<Doubt> doubts;
    std::int64_t tests = 0;
    constexpr std::int64_t ahead = 16; // prefetch distance: the points' addresses are random
    for (std::int64_t cell = begin; cell < end; ++cell)
    {
      cell + ahead < end ? this->Cells.prefetch(cell + ahead) : void();
      const Box<D> box = boxOfCell(this->Cells, this->Mesh, cell);
      if (box.isEmpty())
      {
        continue;
      }
      Point corners[Access::Corners];
      this->Cells.corners(cell, corners);
      const std::conditional_t<D == 2, TriangleFilter, BoxFilter> filter(corners, box);
      this->Buckets.visitNear(box,
        [&](std::uint32_t first, std::uint32_t last)
        {
          tests += last - first;
          for (std::uint32_t entry = first; entry < last; ++entry)
          {
            const auto& at = this->Buckets[entry].At;
            if (!filter.isOutside(at))
            {
              const Point point = pointAt(at);
              this->offer({ entry, std::int32_t(cell) }, point,
                filter.isInside(at) ? Side::Inside : sideOf(corners, point), locations, doubts);
            }
          }
        });
    }
    locations.flush();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Tests += tests;
    this->Doubts.insert(this->Doubts.end(), doubts.begin(), doubts.end());
    if (this->Tests > this->MostTests || this->Doubts.size() > this->MostDoubts)
    {
      this->IsTooMuch = true;
    }
  }

  void offer(
    Doubt at, const Point& point, Side side, Locations& locations, std::vector<Doubt>& doubts)
  {
    std::int32_t none = -1;
    if (side == Side::Inside &&
      this->Claims[at.Entry].compare_exchange_strong(none, at.Cell, std::memory_order_relaxed))
    {
      locations.add(
        this->Points.index(this->Buckets[at.Entry].Number), weighed(this->Cells, at.Cell, point));
    }
    else if (side != Side::Outside)
    {
      doubts.push_back(at);
    }
  }

  /// Chooses a cell for points on cell borders and in overlapping cells.
  void settleDoubts()
  {
    std::sort(this->Doubts.begin(), this->Doubts.end(),
      [](const Doubt& a, const Doubt& b) { return a.Entry < b.Entry; });
    forChunks(std::int64_t(this->Doubts.size()), 1 << 12, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        Locations locations(this->Take);
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
        {
          const std::uint32_t entry = this->Doubts[i].Entry;
          if (i > 0 && this->Doubts[i - 1].Entry == entry)
          {
            continue; // in the same group as the first one
          }
          const Point point = pointAt(this->Buckets[entry].At);
          Choice<Access, Point> choice(this->Cells, this->CellIds, point);
          const std::int32_t claim = this->Claims[entry];
          claim >= 0 ? choice.offer(claim) : void();
          for (std::size_t k = i; k < this->Doubts.size() && this->Doubts[k].Entry == entry; ++k)
          {
            choice.offer(this->Doubts[k].Cell);
          }
          locations.add(this->Points.index(this->Buckets[entry].Number),
            weighed(this->Cells, choice.cell(), point));
        }
        locations.flush();
      });
  }

  const Access& Cells;
  const SimplexMesh& Mesh;
  const std::int64_t* CellIds;
  const AskedPoints& Points;
  const int Threads;
  const TakeLocations& Take;
  const PointBuckets<D> Buckets;
  std::unique_ptr<std::atomic<std::int32_t>[]>
    Claims; ///< for each entry the first cell that has it in its interior
  const std::int64_t MostTests;
  const std::size_t MostDoubts;
  std::mutex Mutex;
  std::int64_t Tests = 0;
  std::vector<Doubt> Doubts;
  std::atomic<bool> IsTooMuch{ false };
};

} // namespace

bool locateInOnePass(const SimplexMesh& mesh, const std::int64_t* cellIds,
  const AskedPoints& points, int threads, const TakeLocations& take)
{
  bool isDone = mesh.Cells <= std::numeric_limits<std::int32_t>::max();
  if (isDone)
  {
    withAccess(mesh,
      [&](const auto& access)
      {
        using Access = std::decay_t<decltype(access)>;
        isDone = Pass<Access>(access, mesh, cellIds, points, threads, take).run();
      });
  }
  return isDone;
}

} // namespace tipp
