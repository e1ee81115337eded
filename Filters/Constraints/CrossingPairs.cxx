// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/CrossingPairs.h"

#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

/// Whether segments are short compared with a box.
class IsShortIn
{
public:
  explicit IsShortIn(const Box2& box)
    : Width(part * (box.xmax / 2 - box.xmin / 2)) // halves, because a difference may overflow
    , Height(part * (box.ymax / 2 - box.ymin / 2))
  {
  }

  bool operator()(const SegmentTree::Item& item) const
  {
    return std::fabs(item.B.x / 2 - item.A.x / 2) <= this->Width &&
      std::fabs(item.B.y / 2 - item.A.y / 2) <= this->Height;
  }

private:
  static constexpr double part = 1.0 / 64;
  double Width;
  double Height;
};

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

/// Short segments are compared in groups. The few long ones are compared individually with all
/// others, since the box of a group with a long segment would overlap most groups.
std::vector<CrossingPair> findCrossingPairs(std::vector<SegmentTree::Item> all, int threads)
{
  const auto firstLong =
    std::stable_partition(all.begin(), all.end(), IsShortIn(SegmentTree::boxOfAll(all, threads)));
  const SegmentTree longOnes(std::vector<SegmentTree::Item>(firstLong, all.end()), threads);
  all.erase(firstLong, all.end());
  const SegmentTree shortOnes(std::move(all), threads);
  const auto groups = std::int64_t(shortOnes.groups());
  std::vector<std::vector<CrossingPair>> found(static_cast<std::size_t>(threads));
  constexpr std::int64_t chunk = 128;
  forChunks(groups + std::int64_t(longOnes.items().size()), chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      std::vector<CrossingPair>& its = found[std::size_t(thread)];
      for (std::int64_t i = begin; i < std::min(end, groups); ++i)
      {
        shortOnes.visitPairs(std::size_t(i),
          [&its](const SegmentTree::Item& one, const SegmentTree::Item& other)
          { compare(one, other, its); });
      }
      for (std::int64_t i = std::max(begin, groups); i < end; ++i)
      {
        const SegmentTree::Item& one = longOnes.items()[std::size_t(i - groups)];
        const auto compareWith = [&](const SegmentTree::Item& other)
        {
          compare(one, other, its);
          return true;
        };
        shortOnes.visitNear(one, compareWith);
        longOnes.visitNear(one,
          [&](const SegmentTree::Item& other) { return other.Id <= one.Id || compareWith(other); });
      }
    });
  std::vector<CrossingPair> pairs;
  for (const std::vector<CrossingPair>& part : found)
  {
    pairs.insert(pairs.end(), part.begin(), part.end());
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace tipp
