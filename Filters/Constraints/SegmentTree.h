// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSegmentTree_h
#define tippSegmentTree_h

#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Whether p, a point on the line through a and b, is strictly between these.
inline bool isBetween(Point2 a, Point2 p, Point2 b)
{
  return lexicographicLess(a, b) ? lexicographicLess(a, p) && lexicographicLess(p, b)
                                 : lexicographicLess(b, p) && lexicographicLess(p, a);
}

inline Box2 expanded(const Box2& box, double margin)
{
  return { { box.Min.x - margin, box.Min.y - margin }, { box.Max.x + margin, box.Max.y + margin } };
}

/// Whether the line through a and b may meet the closed box. False only if it certainly does not.
inline bool lineMayMeet(Point2 a, Point2 b, const Box2& box)
{
  // Every operation below has a relative error of 2^-53; this is ninety times as much.
  constexpr double relative = 1e-14;
  constexpr double absolute = 1e-300;    // for products that underflow
  constexpr double smallest = 0x1p-1070; // for halves of denormal numbers
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const auto [centerX, centerY] = box.center();
  const double halfX = box.Max.x / 2 - box.Min.x / 2;
  const double halfY = box.Max.y / 2 - box.Min.y / 2;
  const double distance = std::fabs(dx * (centerY - a.y) - dy * (centerX - a.x));
  const double reach = std::fabs(dx) * halfY + std::fabs(dy) * halfX;
  const double error = relative *
      (std::fabs(dx) * (std::fabs(centerY) + std::fabs(a.y) + halfY) +
        std::fabs(dy) * (std::fabs(centerX) + std::fabs(a.x) + halfX)) +
    smallest * (std::fabs(dx) + std::fabs(dy)) + absolute;
  return !(distance > reach + error); // also true after an overflow
}

/// A packed tree of bounding boxes over segments that are sorted along a curve.
class SegmentTree
{
public:
  struct Item
  {
    Point2 A;
    Point2 B;
    std::int64_t Id; ///< chosen by the caller

    Box2 box() const { return Box2::of(this->A, this->B); }
  };

  explicit SegmentTree(std::vector<Item> segments, int threads = 1);

  /// The bounding box of all segments; without segments, an empty box.
  static Box2 boxOfAll(const std::vector<Item>& segments, int threads);

  static constexpr std::int64_t Chunk = 8192; ///< number of items that a thread processes at a time

  const std::vector<Item>& items() const { return this->Items; }

  /// Sets the Id of each item to its index among the items. Returns the previous Ids.
  std::vector<std::int64_t> nameByPosition();

  /// Calls visit(item) for each segment whose bounding box overlaps the box, until it returns
  /// false.
  template <typename Visit>
  void visitNear(const Box2& box, const Visit& visit) const
  {
    this->visitNodes([&box](const Box2& node) { return box.meets(node); },
      [&](const Item& item) { return !box.meets(item.box()) || visit(item); });
  }

  /// As above, for segments whose bounding box this segment may meet, or come within `margin` of.
  template <typename Visit>
  void visitNear(const Item& segment, const Visit& visit, double margin = 0) const
  {
    const Box2 box = expanded(segment.box(), margin);
    const auto isNear = [&](const Box2& node)
    { return box.meets(node) && lineMayMeet(segment.A, segment.B, expanded(node, margin)); };
    this->visitNodes(
      isNear, [&](const Item& item) { return !box.meets(item.box()) || visit(item); });
  }

  /// The number of groups of neighbouring items, for visitPairs().
  std::size_t groups() const { return this->Levels.empty() ? 0 : this->Levels.front().size(); }

  /// Calls visit(item, item) for all pairs with overlapping bounding boxes, of an item in this
  /// group and an item in this or a later group. For short segments, since the whole group is
  /// searched at once.
  template <typename Visit>
  void visitPairs(std::size_t group, const Visit& visit) const
  {
    const Box2& box = this->Levels.front()[group];
    const Item* const begin = this->Items.data() + group * Fanout;
    const Item* const end = this->Items.data() + std::min(this->Items.size(), (group + 1) * Fanout);
    this->visitNodes([&box](const Box2& node) { return box.meets(node); },
      [&](const Item& other)
      {
        const Box2 otherBox = other.box();
        if (&other >= begin && box.meets(otherBox))
        {
          for (const Item* one = begin; one != end && one != &other; ++one)
          {
            if (otherBox.meets(one->box()))
            {
              visit(*one, other);
            }
          }
        }
        return true;
      });
  }

private:
  static constexpr std::size_t Fanout = 8;

  template <typename IsNear, typename Visit>
  void visitNodes(const IsNear& isNear, const Visit& visit) const
  {
    if (!this->Levels.empty())
    {
      this->visitNode(this->Levels.size() - 1, 0, isNear, visit);
    }
  }

  template <typename IsNear, typename Visit>
  bool visitNode(
    std::size_t level, std::size_t node, const IsNear& isNear, const Visit& visit) const
  {
    if (!isNear(this->Levels[level][node]))
    {
      return true;
    }
    const std::size_t below = level == 0 ? this->Items.size() : this->Levels[level - 1].size();
    const std::size_t end = std::min(below, (node + 1) * Fanout);
    for (std::size_t i = node * Fanout; i < end; ++i)
    {
      if (!(level == 0 ? visit(this->Items[i]) : this->visitNode(level - 1, i, isNear, visit)))
      {
        return false;
      }
    }
    return true;
  }

  std::vector<Item> Items;
  std::vector<std::vector<Box2>> Levels; ///< boxes of groups of items, of these, ..., the root
};

/// The Ids of two segments that cross, the lower first.
using CrossingPair = std::array<std::int64_t, 2>;

/// All pairs of segments that cross at a point in the interior of both, sorted. Exact.
std::vector<CrossingPair> findCrossingPairs(std::vector<SegmentTree::Item> segments, int threads);

} // namespace tipp

#endif
