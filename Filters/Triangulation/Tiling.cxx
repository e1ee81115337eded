// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Tiling.h"

#include <algorithm>

namespace tipp
{
namespace
{

std::pair<Box2, Box2> cutBox(const Box2& box, int axis, double at)
{
  std::pair<Box2, Box2> halves{ box, box };
  (axis == 0 ? halves.first.xmax : halves.first.ymax) = at;
  (axis == 0 ? halves.second.xmin : halves.second.ymin) = at;
  return halves;
}

/// A place inside (low, high) that splits off `part` of it, or high where none is representable.
double between(double low, double high, double part)
{
  return std::clamp(low * (1 - part) + high * part, low, high);
}

} // namespace

std::int32_t Tiling::addBox(const Box2& box)
{
  this->Boxes.push_back(box);
  return ~(this->size() - 1);
}

Tiling Tiling::grid(const Box2& domain, int columns, int rows)
{
  Tiling tiling;
  tiling.Domain = domain;
  tiling.Root = tiling.cutGrid(domain, columns, rows);
  return tiling;
}

std::int32_t Tiling::cutGrid(const Box2& box, int columns, int rows)
{
  if (columns == 1 && rows == 1)
  {
    return this->addBox(box);
  }
  const int axis = columns >= rows ? 0 : 1;
  const int count = axis == 0 ? columns : rows;
  const int lower = count / 2;
  const double low = axis == 0 ? box.xmin : box.ymin;
  const double high = axis == 0 ? box.xmax : box.ymax;
  const double at = between(low, high, double(lower) / count);
  const auto halves = cutBox(box, axis, at);
  const std::size_t place = this->Cuts.size();
  this->Cuts.push_back({ at, axis, { 0, 0 } });
  const auto child = [&](const Box2& half, int part)
  { return axis == 0 ? this->cutGrid(half, part, rows) : this->cutGrid(half, columns, part); };
  const std::int32_t first = child(halves.first, lower);
  const std::int32_t second = child(halves.second, count - lower);
  this->Cuts[place].Below[0] = first;
  this->Cuts[place].Below[1] = second;
  return static_cast<std::int32_t>(place);
}

Tiling Tiling::balanced(const Box2& domain, std::vector<Point2> sample, int count)
{
  Tiling tiling;
  tiling.Domain = domain;
  tiling.Root = tiling.cutSample(domain, sample.data(), sample.data() + sample.size(), count);
  return tiling;
}

/// Cuts the longer side, half way between two neighbouring points of the sample.
std::int32_t Tiling::cutSample(const Box2& box, Point2* begin, Point2* end, int count)
{
  const std::ptrdiff_t lower = (end - begin) * (count / 2) / std::max(count, 1);
  if (count <= 1 || lower == 0)
  {
    return this->addBox(box);
  }
  const int axis = box.xmax - box.xmin >= box.ymax - box.ymin ? 0 : 1;
  const auto along = [axis](const Point2& p) { return axis == 0 ? p.x : p.y; };
  const auto less = [&along](const Point2& p, const Point2& q) { return along(p) < along(q); };
  Point2* middle = begin + lower;
  std::nth_element(begin, middle, end, less);
  const double at = between(along(*std::max_element(begin, middle, less)), along(*middle), 0.5);

  const auto halves = cutBox(box, axis, at);
  const std::size_t place = this->Cuts.size();
  this->Cuts.push_back({ at, axis, { 0, 0 } });
  const std::int32_t first = this->cutSample(halves.first, begin, middle, count / 2);
  const std::int32_t second = this->cutSample(halves.second, middle, end, count - count / 2);
  this->Cuts[place].Below[0] = first;
  this->Cuts[place].Below[1] = second;
  return static_cast<std::int32_t>(place);
}

} // namespace tipp
