// SPDX-License-Identifier: BSD-3-Clause
// Compares crossings and near segments from SegmentTiles with tests of all pairs.
#include "TemporaryFolder.h"

#include "Constraints/OnDisk/SplitStored.h"
#include "Predicates/ExactPredicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Items = std::vector<SegmentTree::Item>;
using Pair = std::pair<std::int64_t, std::int64_t>;

/// `kind` 0: segments of any length; 1: mostly short segments; 2: ends at lattice points, so that
/// segments have common ends and overlap.
Items randomSegments(int kind, std::size_t count, double scale, unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  Items items;
  while (items.size() < count)
  {
    Point2 a{ any(random), any(random) };
    Point2 b{ any(random), any(random) };
    if (kind == 1 && items.size() % 20 != 0)
    {
      b = { a.x + 0.03 * b.x, a.y + 0.03 * b.y };
    }
    if (kind == 2)
    {
      a = { std::floor(9 * a.x), std::floor(9 * a.y) };
      b = { std::floor(9 * b.x), std::floor(9 * b.y) };
    }
    if (!(a == b))
    {
      items.push_back({ { scale * a.x, scale * a.y }, { scale * b.x, scale * b.y },
        std::int64_t(3 * items.size() + 1) });
    }
  }
  return items;
}

SegmentTiles tilesOf(const TemporaryFolder& folder, const Items& items, int tiles)
{
  return { folder.path("tiles"),
    [&items](const SegmentTiles::Visit& visit)
    { std::for_each(items.begin(), items.end(), visit); },
    tiles, 2 };
}

class Tiles : public testing::TestWithParam<int>
{
};

TEST_P(Tiles, FindAllPairsThatCross)
{
  const TemporaryFolder folder;
  for (const int kind : { 0, 1, 2 })
  {
    for (const double scale : { 1.0, 1e-300, 1e300 })
    {
      const Items items = randomSegments(kind, 300, scale, unsigned(kind));
      std::set<Pair> expected;
      for (std::size_t i = 0; i < items.size(); ++i)
      {
        for (std::size_t j = 0; j < i; ++j)
        {
          if (crossProperly(items[j].A, items[j].B, items[i].A, items[i].B))
          {
            expected.insert({ items[j].Id, items[i].Id });
          }
        }
      }
      std::set<Pair> found;
      tilesOf(folder, items, GetParam())
        .findCrossings(
          [&](std::int64_t one, std::int64_t other) {
            found.insert({ one, other });
          });
      ASSERT_EQ(expected, found) << kind << " " << scale;
      ASSERT_FALSE(expected.empty());
    }
  }
}

TEST_P(Tiles, FindSegmentsNearOthers)
{
  const TemporaryFolder folder;
  Items items = randomSegments(1, 300, 1, 7);
  const std::size_t random = items.size();
  // Each segment gets a copy so near that rounding may matter, and another far from it.
  for (std::size_t i = 0; i < random; ++i)
  {
    const auto [a, b, id] = items[i];
    constexpr double unit = 0x1p-53;
    items.push_back({ { a.x, a.y + 20 * unit }, { b.x, b.y + 20 * unit }, id + 1 });
    items.push_back({ { a.x, a.y + 2 }, { b.x, b.y + 2 }, id + 2 });
  }
  const SegmentTiles tiles = tilesOf(folder, items, GetParam());
  for (std::size_t wanted = 0; wanted < random; wanted += 7)
  {
    std::set<std::int64_t> near;
    const SegmentTree::Item& its = items[wanted];
    tiles.findNear(
      [&](std::int64_t id) { return id == its.Id; }, [&](std::int64_t id) { near.insert(id); });
    EXPECT_EQ(1U, near.count(its.Id));
    EXPECT_EQ(1U, near.count(its.Id + 1));
    EXPECT_EQ(0U, near.count(its.Id + 2));
    for (const SegmentTree::Item& item : items)
    {
      if (crossProperly(its.A, its.B, item.A, item.B))
      {
        EXPECT_EQ(1U, near.count(item.Id));
      }
    }
  }
}

/// The steps between neighbouring lattice points along a segment between two of these.
void countSteps(Point2 a, Point2 b, std::map<std::array<double, 4>, int>& counts)
{
  const auto steps = std::gcd(std::int64_t(b.x - a.x), std::int64_t(b.y - a.y));
  for (std::int64_t i = 0; i < steps; ++i)
  {
    const auto at = [&](std::int64_t step)
    {
      const double part = double(step);
      return Point2{ a.x + (b.x - a.x) / double(steps) * part,
        a.y + (b.y - a.y) / double(steps) * part };
    };
    const Point2 p = at(i);
    const Point2 q = at(i + 1);
    const auto [low, high] =
      std::minmax(p, q, [](Point2 one, Point2 other) { return lexicographicLess(one, other); });
    ++counts[{ std::round(low.x), std::round(low.y), std::round(high.x), std::round(high.y) }];
  }
}

TEST_P(Tiles, FindPartsThatEarlierSegmentsCover)
{
  const TemporaryFolder folder;
  Items items = randomSegments(2, 300, 1, 3);
  items.push_back(items.front());
  items.back().Id = 2;
  std::map<std::array<double, 4>, int> all;
  std::map<std::array<double, 4>, int> left;
  std::map<std::int64_t, Point2> ends;
  tilesOf(folder, items, GetParam())
    .findCovered(
      [&](std::int64_t id, Point2 end) { EXPECT_TRUE(ends.emplace(id, end).second) << "twice"; });
  EXPECT_GT(ends.size(), 50u);
  for (const SegmentTree::Item& item : items)
  {
    countSteps(item.A, item.B, all);
    const auto covered = ends.find(item.Id);
    const bool isUp = lexicographicLess(item.A, item.B);
    const Point2 low = isUp ? item.A : item.B;
    countSteps(covered == ends.end() ? low : covered->second, isUp ? item.B : item.A, left);
  }
  ASSERT_EQ(all.size(), left.size());
  for (const auto& [step, count] : left)
  {
    EXPECT_EQ(1u, all.count(step));
    EXPECT_EQ(1, count);
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, Tiles, testing::Values(1, 2, 7, 60));

TEST(SegmentTilesOfNothing, FindNothing)
{
  const TemporaryFolder folder;
  const SegmentTiles tiles = tilesOf(folder, {}, 4);
  tiles.findCrossings([](std::int64_t, std::int64_t) { FAIL(); });
  tiles.findNear([](std::int64_t) { return true; }, [](std::int64_t) { FAIL(); });
}

} // namespace
