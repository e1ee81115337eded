// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHashGrid_h
#define tippHashGrid_h

#include "Arrays/Buffer.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace tipp
{

/// A hash grid in D dimensions: lists of kept points by the hash of their cell. Cells are at least
/// twice as wide as the distance, so the points close to a position are in the cells within half a
/// cell's width of it.
template <std::size_t D>
class HashGrid
{
public:
  using Position = std::array<double, D>;

  /// `capacity`: the largest number of points to keep.
  HashGrid(std::size_t capacity, double distance, double largestCoordinate)
    : Distance(distance)
    // Wide enough that cell indices are below 2^41, where `slack` exceeds the rounding errors.
    , Width(std::max(
        { 2 * distance, std::ldexp(largestCoordinate, -40), std::numeric_limits<double>::min() }))
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
  PointId find(const Position& p) const
  {
    constexpr double slack = 1.0 / 1024;
    const Cell low = this->cellOf(p, -0.5 - slack);
    const Cell high = this->cellOf(p, 0.5 + slack);
    PointId found = -1;
    Cell cell = low;
    for (bool isInside = true; isInside;)
    {
      for (PointId k = this->First[this->slot(cell)]; k >= 0; k = this->Next[std::size_t(k)])
      {
        if ((found < 0 || k < found) && this->isClose(k, p))
        {
          found = k;
        }
      }
      std::size_t axis = 0;
      for (; axis < D && cell[axis]++ == high[axis]; ++axis)
      {
        cell[axis] = low[axis];
      }
      isInside = axis < D;
    }
    return found;
  }

  void keep(const Position& p)
  {
    PointId& first = this->First[this->slot(this->cellOf(p, 0))];
    std::copy(p.begin(), p.end(), this->Coordinates.begin() + D * this->Size);
    this->Next[this->Size] = std::exchange(first, PointId(this->Size));
    ++this->Size;
  }

  /// Returns the coordinates of the kept points, interleaved. The grid must not be used any more.
  Buffer<double> takeCoordinates()
  {
    this->Coordinates.truncate(D * this->Size);
    return std::move(this->Coordinates);
  }

private:
  using Cell = std::array<std::int64_t, D>;

  Cell cellOf(const Position& p, double cellsAway) const
  {
    Cell cell;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      cell[axis] = std::int64_t(std::floor(p[axis] / this->Width + cellsAway));
    }
    return cell;
  }

  std::size_t slot(const Cell& cell) const
  {
    std::uint64_t hash = 0;
    for (const std::int64_t index : cell)
    {
      hash = (hash ^ std::uint64_t(index)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 32;
    }
    return std::size_t(hash & (this->First.size() - 1));
  }

  bool isClose(PointId k, const Position& p) const
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

  double Distance;
  double Width; ///< of a cell
  std::vector<PointId> First;
  Buffer<double> Coordinates;
  Buffer<PointId> Next;
  std::size_t Size = 0;
};

} // namespace tipp

#endif
