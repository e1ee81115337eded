// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/BoundaryCells.h"

#include "Kernel/Pairs.h"

#include <cmath>
#include <numeric>

namespace tipp
{

template <int D>
void BoundaryCells<D>::append(const BoundaryCells& others)
{
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t set = 0; set < others.Sets.size(); ++set)
  {
    numbers.push_back(this->Sets.number(others.Sets.begin(set), others.Sets.end(set)));
  }
  this->Cells.insert(this->Cells.end(), others.Cells.begin(), others.Cells.end());
  this->SetOf.reserve(this->SetOf.size() + others.SetOf.size());
  for (const std::uint32_t set : others.SetOf)
  {
    this->SetOf.push_back(numbers[set]);
  }
}

namespace
{

double meanLongSide(const Tiling& tiling)
{
  double sum = 0;
  for (PartitionIndex i = 0; i < tiling.size(); ++i)
  {
    const Box2& box = tiling.box(i);
    sum += std::max(box.width(0), box.width(1)) / tiling.size();
  }
  return sum;
}

int stepsAlong(double side, double spacing)
{
  constexpr double most = 4096;
  return static_cast<int>(std::clamp(std::ceil(side / spacing), 1.0, most));
}

/// Returns the indices of the first points with the smallest and the largest x and y. One pass
/// finds the block of each, and only these blocks are searched.
std::array<std::size_t, 4> findOutmost(const Point2* points, std::size_t count)
{
  constexpr std::size_t block = 1024;
  const auto boundOf = [](const Box2& box, std::size_t side)
  { return side < 2 ? box.Min[side] : box.Max[side - 2]; };
  Box2 bounds = Box2::empty();
  std::array<std::size_t, 4> found{ 0, 0, 0, 0 };
  for (std::size_t begin = 0; begin < count; begin += block)
  {
    Box2 all = bounds;
    all.extend(extentOf(points + begin, std::min(block, count - begin)).Bounds);
    for (std::size_t side = 0; side < 4; ++side)
    {
      found[side] = boundOf(all, side) != boundOf(bounds, side) ? begin : found[side];
    }
    bounds = all;
  }
  for (std::size_t side = 0; side < 4; ++side)
  {
    while (points[found[side]][side % 2] != boundOf(bounds, side))
    {
      ++found[side];
    }
  }
  return found;
}

} // namespace

double outward(double bound, double direction, double margin)
{
  double moved = bound + direction * margin;
  for (int i = 0; i < 4; ++i)
  {
    bound = std::nextafter(bound, direction * HUGE_VAL);
  }
  return direction > 0 ? std::max(moved, bound) : std::min(moved, bound);
}

std::vector<BoundaryVertex> makeArtificialPoints(const Tiling& tiling)
{
  const double margin = meanLongSide(tiling);
  const Box2& domain = tiling.domain();
  const Box2 frame = { { outward(domain.Min.x, -1, margin), outward(domain.Min.y, -1, margin) },
    { outward(domain.Max.x, 1, margin), outward(domain.Max.y, 1, margin) } };
  const double width = frame.width(0);
  const double height = frame.width(1);
  std::vector<BoundaryVertex> vertices;
  if (!std::isfinite(width) || !std::isfinite(height))
  {
    return vertices;
  }
  const auto add = [&](double x, double y)
  {
    const Point2 p = { x, y };
    vertices.push_back({ p, -1 - std::int64_t(vertices.size()), tiling.locate(p) });
  };
  const int columns = stepsAlong(width, margin);
  for (int i = 0; i <= columns; ++i)
  {
    const double x = i < columns ? frame.Min.x + width * (double(i) / columns) : frame.Max.x;
    add(x, frame.Min.y);
    add(x, frame.Max.y);
  }
  const int rows = stepsAlong(height, margin);
  for (int i = 1; i < rows; ++i)
  {
    const double y = frame.Min.y + height * (double(i) / rows);
    add(frame.Min.x, y);
    add(frame.Max.x, y);
  }
  return vertices;
}

std::vector<std::size_t> chooseInitialPoints(
  const Point2* points, std::size_t count, std::size_t wanted)
{
  constexpr std::size_t sides = 4;
  std::vector<std::size_t> chosen;
  if (count <= wanted)
  {
    chosen.resize(count);
    std::iota(chosen.begin(), chosen.end(), 0);
    return chosen;
  }
  const auto isChosen = [&](std::size_t i)
  { return std::find(chosen.begin(), chosen.end(), i) != chosen.end(); };
  if (wanted >= 2 * sides)
  {
    for (const std::size_t i : findOutmost(points, count))
    {
      if (!isChosen(i))
      {
        chosen.push_back(i);
      }
    }
  }
  const std::size_t spaced = wanted - chosen.size();
  for (std::size_t i = 0; i < spaced; ++i)
  {
    std::size_t at = (2 * i + 1) * count / (2 * spaced);
    while (isChosen(at))
    {
      at = (at + 1) % count;
    }
    chosen.push_back(at);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

bool partitionsPay(std::int64_t cells, std::int64_t met, double most)
{
  return double(met) <= most * double(cells);
}

bool partitionsPay(const MetPartitions& initialMesh, double most)
{
  std::int64_t cells = 0;
  std::int64_t met = 0;
  for (const std::uint32_t set : initialMesh.SetOf)
  {
    const std::ptrdiff_t size = initialMesh.Sets.end(set) - initialMesh.Sets.begin(set);
    cells += size > 0 ? 1 : 0;
    met += size;
  }
  return partitionsPay(cells, met, most);
}

template struct BoundaryCells<2>;
template struct BoundaryCells<3>;

} // namespace tipp
