// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointCounts_h
#define tippPointCounts_h

#include "Predicates/Geometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Finds out in constant time whether a box may contain any of some points: sums of the numbers of
/// points in the cells of a grid (Crow, Summed-Area Tables for Texture Mapping, 1984).
class PointCounts
{
public:
  /// Points that are not finite are in no box.
  explicit PointCounts(const std::vector<Point3>& points)
    : Sums((Side + 1) * (Side + 1))
  {
    for (const Point3& point : points)
    {
      const Point2 p{ point.x, point.y };
      if (isFinite(p))
      {
        this->Bounds.extend(p);
      }
    }
    for (const Point3& point : points)
    {
      if (isFinite(Point2{ point.x, point.y }))
      {
        ++this->Sums[(this->index(1, point.y) + 1) * (Side + 1) + this->index(0, point.x) + 1];
      }
    }
    for (std::size_t row = 1; row <= Side; ++row)
    {
      for (std::size_t column = 1; column <= Side; ++column)
      {
        this->sum(row, column) +=
          this->sum(row - 1, column) + this->sum(row, column - 1) - this->sum(row - 1, column - 1);
      }
    }
  }

  /// False only if the box contains none of the points.
  bool mayHold(const Box2& box) const
  {
    if (!this->Bounds.meets(box))
    {
      return false;
    }
    const std::size_t left = this->index(0, box.Min.x);
    const std::size_t right = this->index(0, box.Max.x) + 1;
    const std::size_t low = this->index(1, box.Min.y);
    const std::size_t high = this->index(1, box.Max.y) + 1;
    return this->at(high, right) - this->at(low, right) - this->at(high, left) +
      this->at(low, left) >
      0;
  }

private:
  static constexpr std::size_t Side = 1024;

  /// The cell along an axis; it ascends with the coordinate.
  std::size_t index(std::size_t axis, double coordinate) const
  {
    const double width = this->Bounds.width(axis);
    const double at = width > 0 ? (coordinate - this->Bounds.Min[axis]) / width : 0;
    return at > 0 ? std::size_t(std::min(at * double(Side), double(Side - 1))) : 0; // 0 for NaN
  }

  std::int64_t& sum(std::size_t row, std::size_t column)
  {
    return this->Sums[row * (Side + 1) + column];
  }
  std::int64_t at(std::size_t row, std::size_t column) const
  {
    return this->Sums[row * (Side + 1) + column];
  }

  Box2 Bounds = Box2::empty();
  std::vector<std::int64_t> Sums; ///< of the cells below and to the left
};

} // namespace tipp

#endif
