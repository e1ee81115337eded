// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/SegmentTree.h"

#include "Triangulation/PointsView.h"

#include <utility>

namespace tipp
{
namespace
{

/// The bits of a number, each followed by a zero.
std::uint64_t spread(std::uint64_t bits)
{
  bits = (bits | bits << 16) & 0x0000ffff0000ffffU;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ffU;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0fU;
  bits = (bits | bits << 2) & 0x3333333333333333U;
  bits = (bits | bits << 1) & 0x5555555555555555U;
  return bits;
}

/// Where a coordinate lies in a range, as 32 bits.
std::uint64_t cellOf(double value, double low, double high)
{
  constexpr double cells = 4294967295.0;
  const double fraction = (value / 2 - low / 2) / (high / 2 - low / 2);
  return fraction > 0 ? std::uint64_t(std::min(fraction, 1.0) * cells) : 0;
}

std::uint64_t mortonKey(const SegmentTree::Item& item, const Box2& all)
{
  return spread(cellOf(item.A.x / 2 + item.B.x / 2, all.xmin, all.xmax)) |
    spread(cellOf(item.A.y / 2 + item.B.y / 2, all.ymin, all.ymax)) << 1;
}

} // namespace

SegmentTree::SegmentTree(std::vector<Item> segments)
{
  if (segments.empty())
  {
    return;
  }
  Box2 all = boxOf(segments.front().A, segments.front().B);
  for (const Item& item : segments)
  {
    all = unionOf(all, boxOf(item.A, item.B));
  }
  std::vector<std::pair<std::uint64_t, std::size_t>> order(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    order[i] = { mortonKey(segments[i], all), i };
  }
  std::sort(order.begin(), order.end());
  this->Items.reserve(segments.size());
  for (const auto& entry : order)
  {
    this->Items.push_back(segments[entry.second]);
  }
  std::vector<Box2> boxes;
  for (const Item& item : this->Items)
  {
    boxes.push_back(boxOf(item.A, item.B));
  }
  do
  {
    std::vector<Box2> level;
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
      i % Fanout == 0 ? level.push_back(boxes[i])
                      : void(level.back() = unionOf(level.back(), boxes[i]));
    }
    this->Levels.push_back(level);
    boxes = std::move(level);
  } while (boxes.size() > 1);
}

} // namespace tipp
