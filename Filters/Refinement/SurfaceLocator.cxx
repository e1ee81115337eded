// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/SurfaceLocator.h"

#include "Constraints/SurfaceValues.h"
#include "Locate/CellChoice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tipp
{
namespace
{

double distanceToSegment(Point2 p, Point2 a, Point2 b)
{
  const Point2 along = b - a;
  const Point2 offset = p - a;
  const double square = along.x * along.x + along.y * along.y;
  const double at = square > 0 ? (offset.x * along.x + offset.y * along.y) / square : 0;
  const double nearest = std::min(1.0, std::max(0.0, at));
  return std::hypot(offset.x - nearest * along.x, offset.y - nearest * along.y);
}

} // namespace

void blendTuples(const Buffer<PointBlend>& blends, std::size_t points, Scalar type,
  std::size_t components, void* values)
{
  appendTuples(blends, points, type, components, values,
    [](const PointBlend& blend, const auto& valueAt) { return blend.valueOf(valueAt); });
}

SurfaceLocator::SurfaceLocator(
  PointsView points, const std::int32_t* corners, std::int64_t triangles, int threads)
  : Points(points)
  , Corners(corners)
  , Tree(triangles, threads,
      [this](std::int64_t triangle)
      {
        const std::array<Point2, 3> p = this->cornersOf(triangle);
        Box2 box = Box2::of(p[0], p[1]);
        box.extend(p[2]);
        return box;
      })
{
}

std::array<Point2, 3> SurfaceLocator::cornersOf(std::int64_t triangle) const
{
  return tipp::cornersOf(this->Points, this->Corners, std::size_t(triangle));
}

PointBlend SurfaceLocator::blendAt(std::int64_t triangle, Point2 position) const
{
  const SurfaceTriangle surface(this->cornersOf(triangle));
  PointBlend blend{ {}, surface.weightsAt(position) };
  for (std::size_t i = 0; i < 3; ++i)
  {
    blend.Ids[i] = this->Corners[3 * std::size_t(triangle) + surface.Order[i]];
  }
  return blend;
}

bool SurfaceLocator::find(Point2 position, PointBlend& blend) const
{
  std::int64_t found = -1;
  this->Tree.search(Box2::of(position, position),
    [&](std::int64_t triangle)
    {
      const std::array<Point2, 3> p = this->cornersOf(triangle);
      const bool isInside = sideOf({ p[0], p[1], p[2] }, position) != Side::Outside;
      if (isInside &&
        (found < 0 || SurfaceTriangle(p).isBefore(SurfaceTriangle(this->cornersOf(found)))))
      {
        found = triangle;
      }
    });
  if (found >= 0)
  {
    blend = this->blendAt(found, position);
  }
  return found >= 0;
}

PointBlend SurfaceLocator::findNear(Point2 position) const
{
  PointBlend blend{};
  if (this->find(position, blend))
  {
    return blend;
  }
  std::int64_t nearest = 0;
  double distance = std::numeric_limits<double>::infinity();
  this->Tree.searchNear(position,
    [&](std::int64_t triangle)
    {
      const std::array<Point2, 3> p = this->cornersOf(triangle);
      for (std::size_t i = 0; i < 3; ++i)
      {
        const double its = distanceToSegment(position, p[i], p[(i + 1) % 3]);
        nearest = its < distance ? triangle : nearest;
        distance = std::min(distance, its);
      }
      return distance;
    });
  return this->blendAt(nearest, position);
}

} // namespace tipp
