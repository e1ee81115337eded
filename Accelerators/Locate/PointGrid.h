// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointGrid_h
#define tippPointGrid_h

#include "Locate/MortonOrder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A regular grid over a set of points, which quickly rejects cells whose box contains none of
/// them. The position of each mesh point in the grid is computed once, so cells are tested without
/// reading coordinates.
template <int D>
class PointGrid
{
public:
  using Position = std::array<std::uint16_t, D>;

  /// A grid around the points at(0) ... at(count - 1).
  template <typename At>
  PointGrid(std::int64_t count, int threads, const At& at)
    : Bounds(boundsOf<D>(count, threads, [&at](std::int64_t i) { return Box<D>::of(at(i)); }))
    , Occupied((std::size_t(1) << (D * Bits)) / 64)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      // Infinite if the extent is 0, and 0 if the extent overflows.
      const double extent = this->Bounds.width(axis);
      this->Scale[axis] = (Side - 2) * (1 - 1e-9) / extent;
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::size_t index = this->indexOf(this->position(at(i)));
      this->Occupied[index / 64] |= std::uint64_t(1) << (index % 64);
    }
  }

  /// The grid position of a point, monotonic along each axis: 0 before all points, 1 and more among
  /// them, at most Side - 1.
  Position position(const Point<D>& point) const
  {
    Position result;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      const double at = (point[axis] - this->Bounds.Min[axis]) * this->Scale[axis];
      // NaN, as of 0 times infinity, becomes 1.
      result[axis] = std::uint16_t(at < 0 ? 0 : at > 0 ? 1 + std::min(at, double(Side - 2)) : 1);
    }
    return result;
  }

  /// Whether there may be a point between two positions, the minimum and the maximum over a cell's
  /// corners.
  bool mayHold(const Position& low, const Position& high) const
  {
    std::size_t rows = 1;
    for (std::size_t axis = 1; axis < D; ++axis)
    {
      rows *= std::size_t(high[axis] - low[axis]) + 1;
    }
    if (rows > MostRows)
    {
      return true;
    }
    Position at = low;
    for (std::size_t row = 0; row < rows; ++row)
    {
      const std::size_t first = this->indexOf(at);
      if (this->isAnySet(first, first + (high[0] - low[0])))
      {
        return true;
      }
      for (std::size_t axis = 1; axis < D && at[axis]++ == high[axis]; ++axis)
      {
        at[axis] = low[axis];
      }
    }
    return false;
  }

  /// Returns false if there certainly is no point in the box of a cell. Its corners are indices
  /// into `positions`.
  template <int Corners, typename Id>
  bool mayHold(const std::vector<Position>& positions, const Id* corners) const
  {
    Position low = positions[std::size_t(corners[0])];
    Position high = low;
    for (int i = 1; i < Corners; ++i)
    {
      const Position& corner = positions[std::size_t(corners[i])];
      for (std::size_t axis = 0; axis < D; ++axis)
      {
        low[axis] = std::min(low[axis], corner[axis]);
        high[axis] = std::max(high[axis], corner[axis]);
      }
    }
    return this->mayHold(low, high);
  }

private:
  static constexpr int Bits = D == 2 ? 11 : 7; ///< bits of a position
  static constexpr int Side = 1 << Bits;
  static constexpr std::size_t MostRows = 64;

  std::size_t indexOf(const Position& at) const
  {
    std::size_t index = 0;
    for (std::size_t axis = D; axis-- > 0;)
    {
      index = index << Bits | at[axis];
    }
    return index;
  }

  /// Whether any bit of [first, last] is set.
  bool isAnySet(std::size_t first, std::size_t last) const
  {
    const std::uint64_t from = ~std::uint64_t(0) << (first % 64);
    const std::uint64_t to = ~std::uint64_t(0) >> (63 - last % 64);
    std::size_t word = first / 64;
    if (word == last / 64)
    {
      return (this->Occupied[word] & from & to) != 0;
    }
    std::uint64_t found = (this->Occupied[word] & from) | (this->Occupied[last / 64] & to);
    while (found == 0 && ++word < last / 64)
    {
      found = this->Occupied[word];
    }
    return found != 0;
  }

  Box<D> Bounds;
  std::array<double, D> Scale{};
  std::vector<std::uint64_t> Occupied; ///< one bit per grid box
};

} // namespace tipp

#endif
