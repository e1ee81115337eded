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

/// A regular grid that tells quickly that a cell's box holds none of some points. Each point of a
/// mesh is told its position in the grid once, so that its cells need no coordinates.
template <int D>
class PointGrid
{
public:
  using Position = std::array<std::uint16_t, D>;

  /// A grid around the points at(0) ... at(count - 1), arrays of D coordinates.
  template <typename At>
  PointGrid(std::int64_t count, int threads, const At& at)
    : Bounds(boundsOf<D>(count, threads, [&at](std::int64_t i) { return Box<D>::of(at(i)); }))
    , IsOccupied(std::size_t(1) << (D * Bits))
  {
    for (int axis = 0; axis < D; ++axis)
    {
      const double extent = this->Bounds.High[axis] - this->Bounds.Low[axis];
      this->Scale[axis] = extent > 0 ? Side / extent : 0; // 0 also if that is infinite
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->IsOccupied[this->indexOf(this->position(at(i)))] = true;
    }
  }

  /// Along each axis it never falls where the coordinate rises.
  Position position(const std::array<double, D>& point) const
  {
    Position result;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      const double at = (point[axis] - this->Bounds.Low[axis]) * this->Scale[axis];
      // NaN becomes 0.
      result[axis] = std::uint16_t(at > 0 ? std::min(at, double(Side - 1)) : 0);
    }
    return result;
  }

  /// Whether there may be a point between two positions, the lowest and the highest of a cell's
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
    for (std::size_t row = 0; row < rows; ++row)
    {
      Position at = low;
      std::size_t rest = row;
      for (std::size_t axis = 1; axis < D; ++axis)
      {
        const std::size_t width = std::size_t(high[axis] - low[axis]) + 1;
        at[axis] = std::uint16_t(low[axis] + rest % width);
        rest /= width;
      }
      const auto first = this->IsOccupied.begin() + std::ptrdiff_t(this->indexOf(at));
      if (std::find(first, first + (high[0] - low[0]) + 1, true) != first + (high[0] - low[0]) + 1)
      {
        return true;
      }
    }
    return false;
  }

private:
  static constexpr int Bits = D == 2 ? 10 : 7; ///< of a position
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

  Box<D> Bounds;
  std::array<double, D> Scale{};
  std::vector<bool> IsOccupied;
};

} // namespace tipp

#endif
