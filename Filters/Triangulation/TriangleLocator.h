// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleLocator_h
#define tippTriangleLocator_h

#include "Predicates/ExactPredicates.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Finds the triangle of a Delaunay triangulation that contains a point, exactly: a grid gives a
/// triangle nearby, and a walk from there crosses each edge that the point lies beyond. In a
/// Delaunay triangulation this walk terminates.
class TriangleLocator
{
public:
  /// `corners` has three point indices per triangle; `neighbors` has for each corner the triangle
  /// across the opposite edge, or -1. The arrays are referenced, not copied.
  TriangleLocator(PointsView points, const std::int32_t* corners, const std::int32_t* neighbors,
    std::size_t triangles)
    : Points(points)
    , Corners(corners)
    , Neighbors(neighbors)
  {
    if (triangles == 0)
    {
      return;
    }
    Box2 box = Box2::empty();
    for (std::size_t i = 0; i < 3 * triangles; ++i)
    {
      box.extend(points[std::size_t(corners[i])]);
    }
    this->Low = box.Min;
    constexpr double trianglesPerCell = 4;
    this->Side = std::size_t(std::ceil(std::sqrt(double(triangles) / trianglesPerCell)));
    // The extent of finite points may overflow; half of it does not.
    const auto perUnit = [&](std::size_t axis)
    { return 0.5 * double(this->Side) / (0.5 * box.Max[axis] - 0.5 * box.Min[axis]); };
    this->PerUnit = { perUnit(0), perUnit(1) };
    constexpr std::int32_t none = -1;
    this->Nearby.assign(this->Side * this->Side, none);
    for (std::size_t t = 0; t < triangles; ++t)
    {
      this->Nearby[this->cellOf(points[std::size_t(corners[3 * t])])] = std::int32_t(t);
    }
    std::int32_t last = 0;
    for (std::int32_t& nearby : this->Nearby)
    {
      last = nearby == none ? last : nearby;
      nearby = last;
    }
  }

  /// Returns the index of a triangle that contains the point (closed), or -1 if the point is
  /// outside or not finite.
  std::int64_t find(Point2 point) const
  {
    if (this->Nearby.empty() || !isFinite(point))
    {
      return -1;
    }
    std::int64_t triangle = this->Nearby[this->cellOf(point)];
    std::int64_t before = -1;
    for (;;)
    {
      const std::array<Point2, 3> p = this->cornersOf(triangle);
      std::int64_t next = triangle;
      for (std::size_t i = 0; i < 3 && next == triangle; ++i)
      {
        const std::int64_t neighbor = this->Neighbors[3 * triangle + std::int64_t(i)];
        // The walk has just crossed that edge.
        const bool isKnown = neighbor == before && neighbor >= 0;
        if (!isKnown && orientation(p[(i + 1) % 3], p[(i + 2) % 3], point) < 0)
        {
          next = neighbor;
        }
      }
      if (next == triangle || next < 0)
      {
        return next;
      }
      before = triangle;
      triangle = next;
    }
  }

  /// Computes the point's barycentric coordinates in a triangle.
  void weights(std::int64_t triangle, Point2 point, double (&weights)[3]) const
  {
    const std::array<Point2, 3> p = this->cornersOf(triangle);
    const auto area = [](Point2 a, Point2 b, Point2 c)
    { return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y); };
    const double whole = area(p[0], p[1], p[2]);
    weights[1] = area(p[0], point, p[2]) / whole;
    weights[2] = area(p[0], p[1], point) / whole;
    weights[0] = 1 - weights[1] - weights[2];
  }

  const std::int32_t* corners(std::int64_t triangle) const { return this->Corners + 3 * triangle; }

private:
  std::size_t cellOf(Point2 point) const
  {
    const auto along = [this](double offset, double perUnit)
    {
      const double at = std::min(offset * perUnit, double(this->Side - 1));
      return at > 0 ? std::size_t(at) : 0;
    };
    return along(point.y - this->Low.y, this->PerUnit.y) * this->Side +
      along(point.x - this->Low.x, this->PerUnit.x);
  }

  std::array<Point2, 3> cornersOf(std::int64_t triangle) const
  {
    const std::int32_t* const v = this->corners(triangle);
    return { this->Points[std::size_t(v[0])], this->Points[std::size_t(v[1])],
      this->Points[std::size_t(v[2])] };
  }

  PointsView Points;
  const std::int32_t* Corners;
  const std::int32_t* Neighbors;
  std::size_t Side = 1; ///< the grid has Side x Side cells
  Point2 Low{ 0, 0 };
  Point2 PerUnit{ 0, 0 };           ///< grid cells per unit of length
  std::vector<std::int32_t> Nearby; ///< by grid cell: a triangle near it; empty without triangles
};

} // namespace tipp

#endif
