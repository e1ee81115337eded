// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/PositionIndex.h"

#include <stdexcept>
#include <utility>

namespace tipp
{

PositionIndex::PositionIndex(std::vector<Point2> points)
  : Points(std::move(points))
{
  if (this->Points.size() >= NoPoint / 4)
  {
    throw std::length_error("There are too many constraints; give fewer.");
  }
  std::size_t slots = 16;
  while (slots < 4 * this->Points.size()) // sparse, since most lookups do not find a point
  {
    slots *= 2;
  }
  this->Slots.assign(slots, std::uint32_t(NoPoint));
  this->Marks.assign(slots / 2, 0);
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    const Point2 p = this->Points[i];
    if (!isFinite(p))
    {
      continue;
    }
    const std::uint64_t hash = hashOf(p);
    this->Marks[hash >> 35 & (this->Marks.size() - 1)] |= std::uint8_t(1U << (hash >> 32 & 7));
    std::size_t slot = hash & (slots - 1);
    while (this->Slots[slot] != NoPoint && !(this->Points[this->Slots[slot]] == p))
    {
      slot = (slot + 1) & (slots - 1);
    }
    if (this->Slots[slot] == NoPoint)
    {
      this->Slots[slot] = std::uint32_t(i);
    }
  }
}

std::int64_t PositionIndex::find(Point2 position) const
{
  const std::uint64_t hash = hashOf(position);
  return this->isMarked(hash) ? this->lookUp(position, hash) : -1;
}

std::int64_t PositionIndex::lookUp(Point2 position, std::uint64_t hash) const
{
  const std::size_t last = this->Slots.size() - 1;
  for (std::size_t slot = hash & last; this->Slots[slot] != NoPoint; slot = (slot + 1) & last)
  {
    if (this->Points[this->Slots[slot]] == position)
    {
      return this->Slots[slot];
    }
  }
  return -1;
}

MatchedPositions matchPositions(PointsView points, PointsView others)
{
  std::vector<Point2> positions;
  others.forEach(0, others.size(), [&](std::size_t, Point2 p) { positions.push_back(p); });
  const PositionIndex index(positions);
  constexpr PointId none = -1;
  MatchedPositions result;
  result.Ids.assign(others.size(), none);
  points.forBlocks(0, points.size(),
    [&](std::size_t first, const Point2* block, std::size_t count)
    {
      index.findAll(block, count,
        [&](std::size_t i, std::size_t found) {
          result.Ids[found] = result.Ids[found] == none ? PointId(first + i) : result.Ids[found];
        });
    });
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    const std::int64_t first = index.find(positions[i]);
    PointId& id = result.Ids[first < 0 ? i : std::size_t(first)];
    if (id == none)
    {
      id = PointId(points.size() + result.New.size());
      result.New.push_back(i);
    }
    result.Ids[i] = id;
  }
  return result;
}

} // namespace tipp
