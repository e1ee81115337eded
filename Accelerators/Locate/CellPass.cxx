// SPDX-License-Identifier: BSD-3-Clause
#include "Locate/CellLocator.h"

#include "Locate/CellChoice.h"
#include "Locate/PointsInBox.h"

#include <algorithm>
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

/// Decides quickly for most points whether they lie in a cell.
class TriangleFilter
{
public:
  TriangleFilter(const Point2 (&corners)[3], const Box2& box)
    : Around(box)
    , A(corners[0])
    , B(corners[1])
    , C(corners[2])
  {
    const double area = (this->B.x - this->A.x) * (this->C.y - this->A.y) -
      (this->B.y - this->A.y) * (this->C.x - this->A.x);
    if (area < 0)
    {
      std::swap(this->B, this->C);
    }
    // The error bound of orientation(), with the box's extents as the largest factors, plus a
    // margin for the rounding of the area, whose sign is used. Infinite after an overflow.
    constexpr double relative = 3.3306690738754716e-16;
    this->Bound = 8 * relative * box.width(0) * box.width(1) + 1e-300;
  }

  /// True only if the point is outside.
  bool isOutside(Point2 at) const
  {
    // Branch-free. NaN, after an overflow, does not count as outside.
    const int isApart = int(at.x < this->Around.Min.x) | int(at.x > this->Around.Max.x) |
      int(at.y < this->Around.Min.y) | int(at.y > this->Around.Max.y);
    return (isApart | int(this->lowest(at) < -this->Bound)) != 0;
  }
  /// True only if the point of the box is strictly inside.
  bool isInside(Point2 at) const { return this->lowest(at) > this->Bound; }

private:
  /// The lowest of the three orientations.
  double lowest(Point2 at) const
  {
    const double ax = this->A.x - at.x;
    const double ay = this->A.y - at.y;
    const double bx = this->B.x - at.x;
    const double by = this->B.y - at.y;
    const double cx = this->C.x - at.x;
    const double cy = this->C.y - at.y;
    const double ab = ax * by - ay * bx;
    const double bc = bx * cy - by * cx;
    const double ca = cx * ay - cy * ax;
    const double first = ab < bc ? ab : bc;
    // If one of them is NaN, so is their sum.
    return std::isfinite(ab + bc + ca) ? (first < ca ? first : ca)
                                       : std::numeric_limits<double>::quiet_NaN();
  }

  const Box2& Around;
  Point2 A;
  Point2 B;
  Point2 C;
  double Bound;
};

/// In space a box is enough.
class BoxFilter
{
public:
  BoxFilter(const Point3 (&)[4], const Box3& box)
    : Around(box)
  {
  }
  bool isOutside(const Point3& at) const { return !this->Around.contains(at); }
  bool isInside(const Point3&) const { return false; }

private:
  const Box3& Around;
};

/// The pass over the cells of a mesh, which look for their points in GridBuckets or PointRows.
template <typename Access, typename Search>
class Pass
{
public:
  static constexpr int D = Access::Dimension;
  using Point = typename Access::Point;

  Pass(const Access& access, const SimplexMesh& mesh, const std::int64_t* cellIds,
    const AskedPoints& points, const Search& search, int threads, const TakeLocations& take)
    : Cells(access)
    , Mesh(mesh)
    , CellIds(cellIds)
    , Points(points)
    , Near(search)
    , Threads(threads)
    , Take(take)
    , Claims(new std::atomic<std::int32_t>[search.size()])
    , MostTests(testsPerItem * (mesh.Cells + points.Count))
    , MostDoubts(8 * std::size_t(points.Count) + 1024)
  {
    forIndices(
      std::int64_t(search.size()),
      [&](std::int64_t i) { this->Claims[std::size_t(i)].store(-1, std::memory_order_relaxed); },
      threads, 1 << 16);
  }

  bool run()
  {
    forChunks(this->Mesh.Cells, 1 << 12, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        if (!this->IsTooMuch)
        {
          this->addCells(begin, end);
        }
      });
    if (this->IsTooMuch || !this->isEachClaimKept())
    {
      return false;
    }
    this->settleDoubts();
    return true;
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
    std::int64_t claims = 0;
    constexpr std::int64_t ahead = 32; // prefetch distance: the points' addresses are random
    for (std::int64_t cell = begin; cell < end; ++cell)
    {
      // Many at once, so that the waits for their pages overlap.
      for (std::int64_t next = cell == begin ? begin : cell + ahead;
           (cell - begin) % ahead == 0 && next < std::min(cell + 2 * ahead, end); ++next)
      {
        this->Cells.prefetch(next);
      }
      const Box<D> box = boxOfCell(this->Cells, this->Mesh, cell);
      if (box.isEmpty())
      {
        continue;
      }
      Point corners[Access::Corners];
      this->Cells.corners(cell, corners);
      const std::conditional_t<D == 2, TriangleFilter, BoxFilter> filter(corners, box);
      this->Near.visitNear(box,
        [&](std::uint32_t entry, const Point& point)
        {
          ++tests;
          if (!filter.isOutside(point))
          {
            const Doubt here{ entry, std::int32_t(cell) };
            const Side side = filter.isInside(point) ? Side::Inside : sideOf(corners, point);
            if (side == Side::Inside && this->claim(here))
            {
              ++claims;
              locations.add(
                this->Points.index(this->Near.number(entry)), weighed(this->Cells, cell, point));
            }
            else if (side != Side::Outside)
            {
              doubts.push_back(here);
            }
          }
        });
    }
    locations.flush();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Tests += tests;
    this->ClaimedPoints += claims;
    this->Doubts.insert(this->Doubts.end(), doubts.begin(), doubts.end());
    if (this->Tests > this->MostTests || this->Doubts.size() > this->MostDoubts)
    {
      this->IsTooMuch = true;
    }
  }

  /// Without a locked instruction, which would wait for all that is being fetched. So if cells
  /// overlap two threads may claim a point at once.
  bool claim(Doubt at)
  {
    std::atomic<std::int32_t>& claim = this->Claims[at.Entry];
    const bool isFree = claim.load(std::memory_order_relaxed) < 0;
    if (isFree)
    {
      claim.store(at.Cell, std::memory_order_relaxed);
    }
    return isFree;
  }

  /// Whether no point has been claimed by two threads at once.
  bool isEachClaimKept() const
  {
    const std::int64_t kept = sumOfChunks(std::int64_t(this->Near.size()), 1 << 16, this->Threads,
      [&](std::int64_t begin, std::int64_t end)
      {
        return std::count_if(this->Claims.get() + begin, this->Claims.get() + end,
          [](const auto& claim) { return claim.load(std::memory_order_relaxed) >= 0; });
      });
    return kept == this->ClaimedPoints;
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
          const Point point = this->Near.at(entry);
          Choice<Access> choice(this->Cells, this->CellIds, point);
          const std::int32_t claim = this->Claims[entry];
          if (claim >= 0)
          {
            choice.offer(claim);
          }
          for (std::size_t k = i; k < this->Doubts.size() && this->Doubts[k].Entry == entry; ++k)
          {
            choice.offer(this->Doubts[k].Cell);
          }
          locations.add(this->Points.index(this->Near.number(entry)),
            weighed(this->Cells, choice.cell(), point));
        }
        locations.flush();
      });
  }

  const Access& Cells;
  const SimplexMesh& Mesh;
  const std::int64_t* CellIds;
  const AskedPoints& Points;
  const Search& Near;
  const int Threads;
  const TakeLocations& Take;
  std::unique_ptr<std::atomic<std::int32_t>[]>
    Claims; ///< for each entry the first cell that has it in its interior
  const std::int64_t MostTests;
  const std::size_t MostDoubts;
  std::mutex Mutex;
  std::int64_t Tests = 0;
  std::int64_t ClaimedPoints = 0;
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
        constexpr int D = Access::Dimension;
        const auto at = [&](std::int64_t i) { return access.flattened(points.at(i)); };
        const auto passes = [&](const auto& search)
        {
          return Pass<Access, std::decay_t<decltype(search)>>(
            access, mesh, cellIds, points, search, threads, take)
            .run();
        };
        const PointRows<D> rows(points.Count, threads, at);
        isDone = rows.size() > 0 ? passes(rows) : passes(GridBuckets<D>(points.Count, threads, at));
      });
  }
  return isDone;
}

} // namespace tipp
