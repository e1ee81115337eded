// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Tiling.h"

#include "Triangulation/PartitionSizes.h"

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

/// A coordinate inside (low, high) that splits off the fraction `part`; high if none is
/// representable.
double between(double low, double high, double part)
{
  return std::clamp(low * (1 - part) + high * part, low, high);
}

} // namespace

/// Several points descend the tree together: no branch depends on a point, and the loads of
/// different points overlap.
void Tiling::locate(const Point2* points, std::size_t count, std::uint32_t* partitions) const
{
  constexpr std::size_t lanes = 8;
  const Node* const nodes = this->Nodes.data();
  std::size_t begin = 0;
  for (; begin + lanes <= count; begin += lanes)
  {
    const Node* at[lanes];
    for (std::size_t i = 0; i < lanes; ++i)
    {
      at[i] = nodes;
    }
    for (std::size_t level = 0; level < this->Depth; ++level)
    {
      for (std::size_t i = 0; i < lanes; ++i)
      {
        const double* const coordinates = &points[begin + i].x;
        at[i] = nodes + at[i]->Child[coordinates[at[i]->Axis] >= at[i]->At];
      }
    }
    for (std::size_t i = 0; i < lanes; ++i)
    {
      partitions[begin + i] = static_cast<std::uint32_t>(at[i]->Partition);
    }
  }
  for (; begin < count; ++begin)
  {
    partitions[begin] = static_cast<std::uint32_t>(this->locate(points[begin], 0));
  }
}

std::int32_t Tiling::addBox(const Box2& box, std::size_t depth)
{
  const std::int32_t place = static_cast<std::int32_t>(this->Nodes.size());
  this->Nodes.push_back({ 0, 0, { place, place }, this->size() });
  this->Boxes.push_back(box);
  this->Depth = std::max(this->Depth, depth);
  return place;
}

std::int32_t Tiling::addCut(int axis, double at)
{
  this->Nodes.push_back({ at, axis, { 0, 0 }, -1 });
  return static_cast<std::int32_t>(this->Nodes.size() - 1);
}

Tiling Tiling::grid(const Box2& domain, int columns, int rows)
{
  if (std::int64_t(columns) * rows > MostPartitions)
  {
    throw std::length_error(std::to_string(columns) + " x " + std::to_string(rows) +
      " partitions are too many; the most are " + std::to_string(MostPartitions) + ".");
  }
  Tiling tiling;
  tiling.Domain = domain;
  tiling.cutGrid(domain, columns, rows, 0);
  return tiling;
}

std::int32_t Tiling::cutGrid(const Box2& box, int columns, int rows, std::size_t depth)
{
  if (columns == 1 && rows == 1)
  {
    return this->addBox(box, depth);
  }
  const int axis = columns >= rows ? 0 : 1;
  const int count = axis == 0 ? columns : rows;
  const int lower = count / 2;
  const double low = axis == 0 ? box.xmin : box.ymin;
  const double high = axis == 0 ? box.xmax : box.ymax;
  const double at = between(low, high, double(lower) / count);
  const auto halves = cutBox(box, axis, at);
  const std::int32_t place = this->addCut(axis, at);
  const auto child = [&](const Box2& half, int part)
  {
    return axis == 0 ? this->cutGrid(half, part, rows, depth + 1)
                     : this->cutGrid(half, columns, part, depth + 1);
  };
  const std::int32_t first = child(halves.first, lower);
  const std::int32_t second = child(halves.second, count - lower);
  Node& cut = this->Nodes[static_cast<std::size_t>(place)];
  cut.Child[0] = first;
  cut.Child[1] = second;
  return place;
}

Tiling Tiling::balanced(const Box2& domain, std::vector<Point2> sample, int count)
{
  Tiling tiling;
  tiling.Domain = domain;
  tiling.cutSample(domain, sample.data(), sample.data() + sample.size(), count, 0);
  return tiling;
}

/// Cuts the longer side half way between two neighbouring sample points. Returns the node.
std::int32_t Tiling::cutSample(
  const Box2& box, Point2* begin, Point2* end, int count, std::size_t depth)
{
  const std::ptrdiff_t lower = (end - begin) * (count / 2) / std::max(count, 1);
  if (count <= 1 || lower == 0)
  {
    return this->addBox(box, depth);
  }
  const int axis = box.xmax - box.xmin >= box.ymax - box.ymin ? 0 : 1;
  const auto along = [axis](const Point2& p) { return axis == 0 ? p.x : p.y; };
  const auto less = [&along](const Point2& p, const Point2& q) { return along(p) < along(q); };
  Point2* middle = begin + lower;
  std::nth_element(begin, middle, end, less);
  const double at = between(along(*std::max_element(begin, middle, less)), along(*middle), 0.5);

  const auto halves = cutBox(box, axis, at);
  const std::int32_t place = this->addCut(axis, at);
  const std::int32_t first = this->cutSample(halves.first, begin, middle, count / 2, depth + 1);
  const std::int32_t second =
    this->cutSample(halves.second, middle, end, count - count / 2, depth + 1);
  Node& cut = this->Nodes[static_cast<std::size_t>(place)];
  cut.Child[0] = first;
  cut.Child[1] = second;
  return place;
}

} // namespace tipp
