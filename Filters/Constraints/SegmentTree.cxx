// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/SegmentTree.h"

#include "Arrays/Concatenated.h"
#include "Locate/MortonOrder.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Predicates/ExactPredicates.h"

#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// The position of a coordinate in a range, as 16 bits.
std::uint32_t cellOf(double value, double low, double high)
{
  constexpr double cells = 65535;
  const double fraction = (value / 2 - low / 2) / (high / 2 - low / 2);
  return fraction > 0 ? std::uint32_t(std::min(fraction, 1.0) * cells) : 0;
}

std::uint64_t mortonKey(const SegmentTree::Item& item, const Box2& all)
{
  return spreadBits<2>(cellOf(item.A.x / 2 + item.B.x / 2, all.Min.x, all.Max.x)) |
    spreadBits<2>(cellOf(item.A.y / 2 + item.B.y / 2, all.Min.y, all.Max.y)) << 1;
}

void compare(
  const SegmentTree::Item& one, const SegmentTree::Item& other, std::vector<CrossingPair>& found)
{
  const bool isConnected =
    one.A == other.A || one.A == other.B || one.B == other.A || one.B == other.B;
  if (!isConnected && crossProperly(one.A, one.B, other.A, other.B))
  {
    found.push_back({ std::min(one.Id, other.Id), std::max(one.Id, other.Id) });
  }
}

} // namespace

Box2 SegmentTree::boxOfAll(const std::vector<Item>& segments, int threads)
{
  return boundsOf<2>(std::int64_t(segments.size()), threads,
    [&segments](std::int64_t i) { return segments[std::size_t(i)].box(); });
}

SegmentTree::SegmentTree(std::vector<Item> segments, int threads)
{
  if (segments.empty())
  {
    return;
  }
  if (segments.size() > std::size_t(UINT32_MAX))
  {
    throw std::length_error("There are too many constraints; give fewer.");
  }
  const Box2 all = boxOfAll(segments, threads);
  const auto count = std::int64_t(segments.size());
  std::vector<std::uint64_t> order(segments.size()); // first sort keys, then indices
  const auto forAll = [threads](std::int64_t items, const auto& body)
  {
    forIndices(
      items, [&body](std::int64_t i) { body(std::size_t(i)); }, threads, Chunk);
  };
  forAll(count, [&](std::size_t i) { order[i] = mortonKey(segments[i], all) << 32 | i; });
  sortByUpperHalf(order, threads);
  this->Items.resize(segments.size());
  forAll(
    count, [&](std::size_t i) { this->Items[i] = segments[std::size_t(order[i] & UINT32_MAX)]; });
  const auto boxesOfGroups = [&](std::size_t items, const auto& boxAt)
  {
    std::vector<Box2> boxes((items + Fanout - 1) / Fanout);
    forAll(std::int64_t(boxes.size()),
      [&](std::size_t group)
      {
        Box2 box = boxAt(group * Fanout);
        for (std::size_t i = group * Fanout + 1; i < std::min(items, (group + 1) * Fanout); ++i)
        {
          box.extend(boxAt(i));
        }
        boxes[group] = box;
      });
    return boxes;
  };
  this->Levels.push_back(
    boxesOfGroups(this->Items.size(), [this](std::size_t i) { return this->Items[i].box(); }));
  while (this->Levels.back().size() > 1)
  {
    const std::vector<Box2>& below = this->Levels.back();
    this->Levels.push_back(
      boxesOfGroups(below.size(), [&below](std::size_t i) { return below[i]; }));
  }
}

std::vector<std::int64_t> SegmentTree::nameByPosition()
{
  std::vector<std::int64_t> names;
  names.reserve(this->Items.size());
  for (Item& item : this->Items)
  {
    names.push_back(std::exchange(item.Id, std::int64_t(names.size())));
  }
  return names;
}

/// Short segments are compared in groups. The few long ones are compared individually with all
/// others, since the box of a group with a long segment would overlap most groups.
std::vector<CrossingPair> findCrossingPairs(std::vector<SegmentTree::Item> all, int threads)
{
  const Box2 box = SegmentTree::boxOfAll(all, threads);
  // Halves, because a difference may overflow.
  constexpr double part = 1.0 / 64;
  const double width = part * (box.Max.x / 2 - box.Min.x / 2);
  const double height = part * (box.Max.y / 2 - box.Min.y / 2);
  const auto firstLong = std::stable_partition(all.begin(), all.end(),
    [width, height](const SegmentTree::Item& item)
    {
      return std::fabs(item.B.x / 2 - item.A.x / 2) <= width &&
        std::fabs(item.B.y / 2 - item.A.y / 2) <= height;
    });
  const SegmentTree longOnes(std::vector<SegmentTree::Item>(firstLong, all.end()), threads);
  all.erase(firstLong, all.end());
  const SegmentTree shortOnes(std::move(all), threads);
  const auto groups = std::int64_t(shortOnes.groups());
  std::vector<std::vector<CrossingPair>> found(static_cast<std::size_t>(threads));
  constexpr std::int64_t chunk = 128;
  forChunks(groups + std::int64_t(longOnes.items().size()), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      std::vector<CrossingPair>& pairs = found[std::size_t(thread)];
      for (std::int64_t i = begin; i < std::min(end, groups); ++i)
      {
        shortOnes.visitPairs(std::size_t(i),
          [&pairs](const SegmentTree::Item& one, const SegmentTree::Item& other)
          { compare(one, other, pairs); });
      }
      for (std::int64_t i = std::max(begin, groups); i < end; ++i)
      {
        const SegmentTree::Item& one = longOnes.items()[std::size_t(i - groups)];
        const auto compareWith = [&](const SegmentTree::Item& other)
        {
          compare(one, other, pairs);
          return true;
        };
        shortOnes.visitNear(one, compareWith);
        longOnes.visitNear(one,
          [&](const SegmentTree::Item& other) { return other.Id <= one.Id || compareWith(other); });
      }
    });
  std::vector<CrossingPair> pairs = concatenated(found);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace tipp
