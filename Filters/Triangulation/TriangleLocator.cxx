// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/TriangleLocator.h"

#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tipp
{
namespace
{

std::size_t cellOf(double offset, double perUnit, std::size_t side)
{
  const double at = std::min(offset * perUnit, double(side - 1));
  return at > 0 ? std::size_t(at) : 0;
}

} // namespace

template <typename Id>
TriangleLocator<Id>::TriangleLocator(
  PointsView points, const Id* corners, const Id* neighbors, std::size_t triangles)
  : Points(points)
  , Corners(corners)
  , Neighbors(neighbors)
{
  if (triangles == 0)
  {
    return;
  }
  const double infinity = std::numeric_limits<double>::infinity();
  Point2 high{ -infinity, -infinity };
  this->Low = { infinity, infinity };
  for (std::size_t i = 0; i < 3 * triangles; ++i)
  {
    const Point2 p = points[std::size_t(corners[i])];
    this->Low = { std::min(this->Low.x, p.x), std::min(this->Low.y, p.y) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y) };
  }
  constexpr double trianglesPerCell = 4;
  this->Side = std::size_t(std::ceil(std::sqrt(double(triangles) / trianglesPerCell)));
  // The extent of finite points may overflow; half of it does not.
  const auto perUnit = [this](double low, double high)
  { return 0.5 * double(this->Side) / (0.5 * high - 0.5 * low); };
  this->PerUnit = { perUnit(this->Low.x, high.x), perUnit(this->Low.y, high.y) };
  constexpr Id none = -1;
  this->Nearby.assign(this->Side * this->Side, none);
  for (std::size_t t = 0; t < triangles; ++t)
  {
    const Point2 p = points[std::size_t(corners[3 * t])];
    this->Nearby[this->row(p.y) * this->Side + this->column(p.x)] = Id(t);
  }
  Id last = 0;
  for (Id& nearby : this->Nearby)
  {
    last = nearby == none ? last : nearby;
    nearby = last;
  }
}

template <typename Id>
std::size_t TriangleLocator<Id>::column(double x) const
{
  return cellOf(x - this->Low.x, this->PerUnit.x, this->Side);
}

template <typename Id>
std::size_t TriangleLocator<Id>::row(double y) const
{
  return cellOf(y - this->Low.y, this->PerUnit.y, this->Side);
}

template <typename Id>
std::int64_t TriangleLocator<Id>::find(Point2 point) const
{
  if (this->Nearby.empty() || !std::isfinite(point.x) || !std::isfinite(point.y))
  {
    return -1;
  }
  std::int64_t triangle =
    std::int64_t(this->Nearby[this->row(point.y) * this->Side + this->column(point.x)]);
  std::int64_t before = -1;
  for (;;)
  {
    Point2 p[3];
    for (int i = 0; i < 3; ++i)
    {
      p[i] = this->Points[std::size_t(this->corners(triangle)[i])];
    }
    std::int64_t next = triangle;
    for (int i = 0; i < 3 && next == triangle; ++i)
    {
      const auto neighbor = std::int64_t(this->Neighbors[3 * triangle + i]);
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

template <typename Id>
void TriangleLocator<Id>::weights(std::int64_t triangle, Point2 point, double (&weights)[3]) const
{
  Point2 p[3];
  for (int i = 0; i < 3; ++i)
  {
    p[i] = this->Points[std::size_t(this->corners(triangle)[i])];
  }
  const auto area = [](Point2 a, Point2 b, Point2 c)
  { return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y); };
  const double whole = area(p[0], p[1], p[2]);
  weights[1] = area(p[0], point, p[2]) / whole;
  weights[2] = area(p[0], p[1], point) / whole;
  weights[0] = 1 - weights[1] - weights[2];
}

template class TriangleLocator<std::int32_t>;
template class TriangleLocator<std::int64_t>;

} // namespace tipp
