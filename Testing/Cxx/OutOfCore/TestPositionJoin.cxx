// SPDX-License-Identifier: BSD-3-Clause
// Tests PositionJoin, which matches the ends of constraints with points on disk, and RowFile.
#include "TemporaryFolder.h"

#include "Constraints/OnDisk/StoredConstraints.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

using Key = std::pair<double, double>;

/// Only a few different positions, so that many are equal. Some coordinates are 0 or -0.
std::vector<Point2> randomPositions(std::size_t count, int side, unsigned seed)
{
  std::mt19937 random(seed);
  const auto coordinate = [&]
  {
    const int value = int(random() % unsigned(2 * side + 1)) - side;
    return value == 0 && random() % 2 == 0 ? -0.0 : value / 7.0;
  };
  std::vector<Point2> positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    positions.push_back({ coordinate(), coordinate() });
  }
  return positions;
}

struct Expected
{
  std::int64_t First = -1; ///< the first number that is wanted at the position
  std::int64_t Point = -1;
};

class PositionJoins : public testing::TestWithParam<std::uint64_t>
{
};

TEST_P(PositionJoins, FindTheFirstPointsAtPositions)
{
  const TemporaryFolder folder;
  for (const int side : { 1, 8, 200 })
  {
    const std::vector<Point2> wanted = randomPositions(3000, side, 1);
    const std::vector<Point2> points = randomPositions(20000, side, 2);
    std::map<Key, Expected> expected;
    const auto at = [&](Point2 p) -> Expected& {
      return expected[{ p.x + 0.0, p.y + 0.0 }];
    };
    PositionJoin join(folder.path("join"), std::int64_t(wanted.size()), 2, GetParam(), 2);
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      const auto number = std::int64_t(i) * 5;
      join.want(wanted[i], number);
      at(wanted[i]).First = at(wanted[i]).First < 0 ? number : at(wanted[i]).First;
    }
    join.seal();
    constexpr std::size_t block = 3000;
    for (std::size_t first = 0; first < points.size(); first += block)
    {
      const std::size_t count = std::min(block, points.size() - first);
      join.add(PointsView(&points[first].x, count, 2),
        [&](std::size_t i, std::size_t c) { return double(first + i) + (c == 0 ? 0 : 0.5); });
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      at(points[i]).Point = at(points[i]).Point < 0 ? std::int64_t(i) : at(points[i]).Point;
    }
    join.finish();
    for (int round = 0; round < 2; ++round)
    {
      std::vector<int> visits(wanted.size(), 0);
      join.forEachMatch(
        [&](const PositionJoin::Match& match)
        {
          const auto number = std::size_t(match.Number / 5);
          ++visits.at(number);
          ASSERT_EQ(wanted[number], match.Position);
          const Expected& its = at(match.Position);
          ASSERT_EQ(its.First, match.First);
          ASSERT_EQ(its.Point >= 0, match.Values != nullptr);
          if (match.Values)
          {
            ASSERT_EQ(double(its.Point), match.Values[0]);
            ASSERT_EQ(double(its.Point) + 0.5, match.Values[1]);
          }
        });
      ASSERT_EQ(std::vector<int>(wanted.size(), 1), visits);
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
}

// Memory for many small buckets, in between, and for only one bucket.
INSTANTIATE_TEST_SUITE_P(
  Memory, PositionJoins, testing::Values(1024, 65536, std::uint64_t(1) << 30));

TEST(RowFile, ReadsBackAnyRangeOfWhatWasAppended)
{
  const TemporaryFolder folder;
  {
    RowFile rows(folder.path("rows"), sizeof(std::int64_t));
    constexpr std::int64_t count = 300000; // fills the file's buffer several times
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::int64_t row = i * i;
      rows.append(&row);
    }
    rows.finish();
    ASSERT_EQ(count, rows.count());
    std::int64_t next = 0;
    rows.forEach<std::int64_t>(
      [&](std::int64_t number, std::int64_t row)
      {
        ASSERT_EQ(next++, number);
        ASSERT_EQ(number * number, row);
      });
    EXPECT_EQ(count, next);
    std::vector<std::int64_t> some(3);
    rows.read(count - 3, 3, some.data());
    EXPECT_EQ((count - 1) * (count - 1), some.back());
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
}

} // namespace
