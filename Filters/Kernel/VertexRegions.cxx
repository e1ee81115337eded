// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/VertexRegions.h"

#include <algorithm>

namespace tipp
{

VertexRegions::VertexRegions(const Point3* points, const std::vector<Index>& vertices, int regions)
{
  const int count = std::clamp(regions, 1, Most);
  constexpr std::size_t perRegion = 1024;
  const std::size_t size = std::min(vertices.size(), perRegion * std::size_t(count));
  std::vector<Point3> sample;
  for (std::size_t i = 0; i < size; ++i)
  {
    sample.push_back(points[vertices[vertices.size() * i / size]]);
  }
  this->cut(sample.data(), sample.data() + size, 0, count);
}

/// Adds the tree of regions [first, first + count) for these vertices.
void VertexRegions::cut(Point3* begin, Point3* end, int first, int count)
{
  const std::size_t node = this->Cuts.size();
  this->Cuts.push_back({ 0, 0, 0, static_cast<std::uint8_t>(first) });
  if (count == 1 || begin == end)
  {
    return;
  }
  Box3 box = Box3::empty();
  std::for_each(begin, end, [&box](const Point3& p) { box.extend(p); });
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
  {
    axis = box.width(k) > box.width(axis) ? k : axis;
  }
  const int lower = count / 2;
  Point3* const middle = begin + (end - begin) * lower / count;
  std::nth_element(
    begin, middle, end, [axis](const Point3& p, const Point3& q) { return p[axis] < q[axis]; });
  const double at = (*middle)[axis];
  this->cut(begin, middle, first, lower);
  const std::size_t second = this->Cuts.size() - node;
  this->cut(middle, end, first + lower, count - lower);
  this->Cuts[node] = { axis, at, second, 0 };
}

} // namespace tipp
