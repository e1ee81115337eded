// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/DegenerateInput.h"

#include "Predicates/Orientation.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
PointsView withModerateMagnitude(PointsView points, const Box2& bounds)
{
  // Determinants have degree four in the coordinates, and rounding errors are 53 bits smaller.
  constexpr int moderate = 200;
  constexpr int largestShift = 1000;
  const double largest = std::max({ std::fabs(bounds.xmin), std::fabs(bounds.xmax),
    std::fabs(bounds.ymin), std::fabs(bounds.ymax) });
  if (largest == 0 || std::abs(std::ilogb(largest)) <= moderate)
  {
    return points;
  }
  const double factor =
    std::ldexp(1.0, std::clamp(-std::ilogb(largest), -largestShift, largestShift));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Point2 p = points[i];
    if (isFinite(p) && (p.x * factor / factor != p.x || p.y * factor / factor != p.y))
    {
      return points;
    }
  }
  return points.scaled(factor);
}

bool CollinearityTest::add(Point2 p)
{
  if (!this->Holds || !isFinite(p) || (this->Found > 0 && p == this->Line[0]))
  {
    return this->Holds;
  }
  if (this->Found < 2)
  {
    this->Line[this->Found++] = p;
  }
  else
  {
    this->Holds = orientation(this->Line[0], this->Line[1], p) == 0;
  }
  return this->Holds;
}

bool areCollinear(PointsView points)
{
  CollinearityTest test;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!test.add(points[i]))
    {
      return false;
    }
  }
  return true;
}

std::vector<Duplicate> sortOutDuplicates(PointsView points)
{
  std::vector<PointId> order;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (isFinite(points[i]))
    {
      order.push_back(static_cast<PointId>(i));
    }
  }
  const auto place = [&points](PointId id) { return points[static_cast<std::size_t>(id)]; };
  std::sort(order.begin(), order.end(),
    [&place](PointId a, PointId b)
    {
      const Point2 p = place(a);
      const Point2 q = place(b);
      return p == q ? a < b : lexicographicLess(p, q);
    });
  std::vector<Duplicate> duplicates;
  PointId first = 0; // the lowest of the coincident points
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (i == 0 || !(place(order[i]) == place(order[i - 1])))
    {
      first = order[i];
    }
    else
    {
      duplicates.push_back({ order[i], first });
    }
  }
  std::sort(duplicates.begin(), duplicates.end(),
    [](const Duplicate& a, const Duplicate& b) { return a.Point < b.Point; });
  return duplicates;
}

} // namespace tipp
