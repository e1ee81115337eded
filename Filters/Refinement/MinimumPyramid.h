// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMinimumPyramid_h
#define tippMinimumPyramid_h

#include "Predicates/Geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace tipp
{

/// The least value in each part of a raster, found in a few steps for a part of any size: every
/// level has the minima of 2 x 2 values of the level before.
class MinimumPyramid
{
public:
  MinimumPyramid() = default;
  MinimumPyramid(const MinimumPyramid&) = delete; // it has pointers into itself
  MinimumPyramid(MinimumPyramid&&) = default;
  MinimumPyramid& operator=(MinimumPyramid&&) = default;
  ~MinimumPyramid() = default;

  /// `values`: row by row, of which there must be at least one. Not owned.
  MinimumPyramid(const double* values, std::size_t columns, std::size_t rows)
    : Columns(columns)
    , Rows(rows)
  {
    Level level{ values, columns };
    for (std::size_t height = rows; level.Columns > 1 || height > 1;)
    {
      const std::size_t halfColumns = (level.Columns + 1) / 2;
      const std::size_t halfRows = (height + 1) / 2;
      std::vector<double> least(halfColumns * halfRows, std::numeric_limits<double>::infinity());
      for (std::size_t y = 0; y < height; ++y)
      {
        for (std::size_t x = 0; x < level.Columns; ++x)
        {
          double& half = least[y / 2 * halfColumns + x / 2];
          half = std::min(half, level.at(x, y));
        }
      }
      this->Levels.push_back(level);
      this->Halves.push_back(std::move(least));
      level = { this->Halves.back().data(), halfColumns };
      height = halfRows;
    }
    this->Levels.push_back(level);
  }

  /// Returns the least value in the columns and rows from `low` to `high`, or in a part that
  /// reaches beyond them by less than their number on each side; infinity if there are none.
  double least(Point2 low, Point2 high) const
  {
    const Point2 last{ double(this->Columns) - 1, double(this->Rows) - 1 };
    const Point2 first{ std::ceil(std::max(low.x, 0.0)), std::ceil(std::max(low.y, 0.0)) };
    const Point2 end{ std::floor(std::min(high.x, last.x)), std::floor(std::min(high.y, last.y)) };
    if (!(first.x <= end.x && first.y <= end.y))
    {
      return std::numeric_limits<double>::infinity();
    }
    return this->least(
      std::size_t(first.x), std::size_t(first.y), std::size_t(end.x), std::size_t(end.y));
  }

private:
  double least(std::size_t left, std::size_t bottom, std::size_t right, std::size_t top) const
  {
    std::size_t level = 0;
    for (; right - left > 2 || top - bottom > 2; ++level)
    {
      left /= 2;
      bottom /= 2;
      right /= 2;
      top /= 2;
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t y = bottom; y <= top; ++y)
    {
      for (std::size_t x = left; x <= right; ++x)
      {
        least = std::min(least, this->Levels[level].at(x, y));
      }
    }
    return least;
  }

  struct Level
  {
    const double* Values;
    std::size_t Columns;

    double at(std::size_t x, std::size_t y) const { return this->Values[y * this->Columns + x]; }
  };

  std::size_t Columns = 0;
  std::size_t Rows = 0;
  std::vector<std::vector<double>> Halves; ///< values of all levels but the first
  std::vector<Level> Levels;
};

} // namespace tipp

#endif
