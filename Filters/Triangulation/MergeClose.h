// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMergeClose_h
#define tippMergeClose_h

#include "Arrays/Buffer.h"
#include "Predicates/Geometry.h"
#include "Triangulation/Duplicate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace tipp
{

/// Returns the largest magnitude of the coordinates of those of `count` points that are finite.
template <int D, typename PositionOf>
double largestCoordinate(std::size_t count, const PositionOf& positionOf)
{
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Point<D> p = positionOf(i);
    for (std::size_t axis = 0; axis < D && isFinite(p); ++axis)
    {
      largest = std::max(largest, std::fabs(p[axis]));
    }
  }
  return largest;
}

/// A grid of cells that are at least twice as wide as a distance, so the points within that
/// distance of a position are in the cells within half a cell's width of it.
template <int D>
class MergeGrid
{
public:
  MergeGrid(double distance, double largestCoordinate)
    // Wide enough that cell indices are below 2^41, where `slack` exceeds the rounding errors.
    : Width(std::max(
        { 2 * distance, std::ldexp(largestCoordinate, -40), std::numeric_limits<double>::min() }))
  {
  }

  /// Returns the hash of the cell that contains a point.
  std::uint64_t hashOf(const Point<D>& p) const { return hashOf(this->cellOf(p, 0)); }

  /// Calls visit(hash) for the cells within half a cell's width of p.
  template <typename Visit>
  void visitNear(const Point<D>& p, const Visit& visit) const
  {
    constexpr double slack = 1.0 / 1024;
    const Cell low = this->cellOf(p, -0.5 - slack);
    const Cell high = this->cellOf(p, 0.5 + slack);
    Cell cell = low;
    for (bool isInside = true; isInside;)
    {
      visit(hashOf(cell));
      std::size_t axis = 0;
      for (; axis < D && cell[axis]++ == high[axis]; ++axis)
      {
        cell[axis] = low[axis];
      }
      isInside = axis < D;
    }
  }

private:
  using Cell = std::array<std::int64_t, D>;

  Cell cellOf(const Point<D>& p, double cellsAway) const
  {
    Cell cell;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      cell[axis] = std::int64_t(std::floor(p[axis] / this->Width + cellsAway));
    }
    return cell;
  }

  static std::uint64_t hashOf(const Cell& cell)
  {
    std::uint64_t hash = 0;
    for (const std::int64_t index : cell)
    {
      hash = (hash ^ std::uint64_t(index)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 32;
    }
    return hash;
  }

  double Width; ///< of a cell
};

/// Lists of kept points by the hash of their cell.
template <int D>
class KeptPoints
{
public:
  /// `capacity`: the largest number of points to keep.
  KeptPoints(std::size_t capacity, double distance, double largestCoordinate)
    : Grid(distance, largestCoordinate)
    , Distance(distance)
    , Coordinates(D * capacity)
    , Next(capacity)
  {
    std::size_t slots = 1;
    while (slots < capacity)
    {
      slots *= 2;
    }
    this->First.assign(slots, -1);
  }

  /// Returns the index of the first kept point within the distance, or -1.
  PointId find(const Point<D>& p) const
  {
    PointId found = -1;
    this->Grid.visitNear(p,
      [&](std::uint64_t hash)
      {
        for (PointId k = this->First[this->slot(hash)]; k >= 0; k = this->Next[std::size_t(k)])
        {
          if ((found < 0 || k < found) && this->isClose(k, p))
          {
            found = k;
          }
        }
      });
    return found;
  }

  void keep(const Point<D>& p)
  {
    PointId& first = this->First[this->slot(this->Grid.hashOf(p))];
    std::copy_n(&p.x, D, this->Coordinates.begin() + D * this->Size);
    this->Next[this->Size] = std::exchange(first, PointId(this->Size));
    ++this->Size;
  }

  /// Returns the coordinates of the kept points, interleaved. This object must not be used any
  /// more.
  Buffer<double> takeCoordinates()
  {
    this->Coordinates.truncate(D * this->Size);
    return std::move(this->Coordinates);
  }

private:
  std::size_t slot(std::uint64_t hash) const
  {
    return std::size_t(hash & (this->First.size() - 1));
  }

  bool isClose(PointId k, const Point<D>& p) const
  {
    const double* const kept = this->Coordinates.data() + D * std::size_t(k);
    if constexpr (D == 2)
    {
      return std::hypot(p[0] - kept[0], p[1] - kept[1]) <= this->Distance;
    }
    else
    {
      return std::hypot(p[0] - kept[0], p[1] - kept[1], p[2] - kept[2]) <= this->Distance;
    }
  }

  MergeGrid<D> Grid;
  double Distance;
  std::vector<PointId> First;
  Buffer<double> Coordinates;
  Buffer<PointId> Next;
  std::size_t Size = 0;
};

/// The points that are left after merging.
struct MergedPoints
{
  Buffer<double> Coordinates; ///< of the kept points, D each
  Buffer<PointId> Ids;        ///< input point indices of the kept points, ascending
  std::vector<Duplicate> Duplicates;
  std::vector<PointId> Rejected;
  bool Aborted = false;
};

/// Merges `count` points; positionOf(i) returns a point: in their order, each point within
/// `distance` of a point kept before it is merged into the first such point. The result depends
/// only on the points and their order.
template <int D, typename PositionOf>
MergedPoints mergeClose(std::size_t count, const PositionOf& positionOf, double distance,
  const std::function<bool(double)>& progress)
{
  constexpr std::size_t reportEvery = 1 << 16;
  MergedPoints merged;
  merged.Ids = Buffer<PointId>(count);
  KeptPoints<D> grid(count, distance, largestCoordinate<D>(count, positionOf));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i % reportEvery == 0 && progress && !progress(double(i) / double(count)))
    {
      merged.Aborted = true;
      break;
    }
    const Point<D> p = positionOf(i);
    if (!isFinite(p))
    {
      merged.Rejected.push_back(PointId(i));
      continue;
    }
    const PointId close = grid.find(p);
    if (close >= 0)
    {
      merged.Duplicates.push_back({ PointId(i), merged.Ids[close] });
      continue;
    }
    grid.keep(p);
    merged.Ids[kept++] = PointId(i);
  }
  merged.Coordinates = grid.takeCoordinates();
  merged.Ids.truncate(kept);
  return merged;
}

} // namespace tipp

#endif
