// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/BoxTiling.h"

#include "CellSets.h"
#include "ExpectAcceleratorError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using tipp::Box3;
using tipp::BoxTiling;

namespace
{

const Box3 Square = { { 0, 0, 0 }, { 8, 4, 0 } };
const Box3 Cube = { { -1, -1, -1 }, { 1, 1, 1 } };

bool meet(const Box3& a, const Box3& b, int dimension)
{
  bool result = true;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
  {
    result = result && a.Min[axis] <= b.Max[axis] && b.Min[axis] <= a.Max[axis];
  }
  return result;
}

std::vector<std::int32_t> meeting(const BoxTiling& tiling, const Box3& box)
{
  std::vector<std::int32_t> ids;
  tiling.forEachMeeting(box, [&](std::int32_t id) { ids.push_back(id); });
  return ids;
}

// Compares for boxes of all sizes. Many have borders on those of the tiling, and some are outside
// the domain.
void expectMeetingAsByBruteForce(const BoxTiling& tiling)
{
  std::mt19937_64 engine(1);
  const Box3& domain = tiling.domain();
  for (int i = 0; i < 500; ++i)
  {
    Box3 box;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(tiling.dimension()); ++axis)
    {
      const auto draw = [&]
      {
        const int step = std::uniform_int_distribution<int>(-2, 18)(engine);
        const double extent = domain.Max[axis] - domain.Min[axis];
        return domain.Min[axis] + extent * step / 16.0 + (engine() % 3 == 0 ? 0.01 : 0.0);
      };
      const double first = draw();
      const double second = draw();
      box.Min[axis] = std::min(first, second);
      box.Max[axis] = std::max(first, second);
    }
    std::vector<std::int32_t> expected;
    for (std::int64_t id = 0; id < tiling.count(); ++id)
    {
      if (meet(tiling.box(id), box, tiling.dimension()))
      {
        expected.push_back(static_cast<std::int32_t>(id));
      }
    }
    ASSERT_EQ(expected, meeting(tiling, box));
  }
}

double volume(const BoxTiling& tiling)
{
  double sum = 0.0;
  for (std::int64_t id = 0; id < tiling.count(); ++id)
  {
    double product = 1.0;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(tiling.dimension()); ++axis)
    {
      product *= tiling.box(id).Max[axis] - tiling.box(id).Min[axis];
    }
    sum += product;
  }
  return sum;
}

} // namespace

TEST(BoxTiling, AGridIsNumberedWithXFastest)
{
  const BoxTiling tiling = BoxTiling::grid(2, Square, { 4, 2, 0 });
  ASSERT_EQ(tiling.count(), 8);
  EXPECT_EQ(tiling.box(0).Min, (tipp::Point3{ 0, 0, 0 }));
  EXPECT_EQ(tiling.box(1).Min, (tipp::Point3{ 2, 0, 0 }));
  EXPECT_EQ(tiling.box(4).Min, (tipp::Point3{ 0, 2, 0 }));
  EXPECT_EQ(tiling.box(7).Max, (tipp::Point3{ 8, 4, 0 }));
}

TEST(BoxTiling, ATreesLeavesAreNumberedAlongTheMortonCurve)
{
  // The root's upper right child is split again.
  const BoxTiling tiling = BoxTiling::tree(2, Square, { 1, -1, -1, -1, 5, -1, -1, -1, -1 });
  ASSERT_EQ(tiling.count(), 7);
  EXPECT_EQ(tiling.box(0).Max, (tipp::Point3{ 4, 2, 0 }));
  EXPECT_EQ(tiling.box(1).Min, (tipp::Point3{ 4, 0, 0 }));
  EXPECT_EQ(tiling.box(2).Min, (tipp::Point3{ 0, 2, 0 }));
  EXPECT_EQ(tiling.box(3).Min, (tipp::Point3{ 4, 2, 0 }));
  EXPECT_EQ(tiling.box(4).Min, (tipp::Point3{ 6, 2, 0 }));
  EXPECT_EQ(tiling.box(6).Max, (tipp::Point3{ 8, 4, 0 }));
}

TEST(BoxTiling, NeighboursShareTheirBorders)
{
  const BoxTiling tiling = BoxTiling::grid(2, { { 0.1, 0.2, 0 }, { 0.7, 0.9, 0 } }, { 7, 3, 1 });
  EXPECT_EQ(tiling.box(0).Max[0], tiling.box(1).Min[0]);
  EXPECT_EQ(tiling.box(0).Max[1], tiling.box(7).Min[1]);
  EXPECT_EQ(tiling.box(20).Max[0], 0.7);
  EXPECT_EQ(tiling.box(20).Max[1], 0.9);
}

TEST(BoxTiling, ABoxMeetsWhatBruteForceFinds)
{
  expectMeetingAsByBruteForce(BoxTiling::grid(2, Square, { 4, 8, 1 }));
  expectMeetingAsByBruteForce(BoxTiling::grid(3, Cube, { 4, 3, 5 }));
  expectMeetingAsByBruteForce(randomTree(2, Square, 5, 1));
  expectMeetingAsByBruteForce(randomTree(3, Cube, 4, 2));
}

TEST(BoxTiling, ATreeFillsItsDomain)
{
  EXPECT_DOUBLE_EQ(volume(randomTree(2, Square, 6, 3)), 32.0);
  EXPECT_DOUBLE_EQ(volume(randomTree(3, Cube, 4, 4)), 8.0);
}

TEST(BoxTiling, AnAxisWithoutExtentIsNotCut)
{
  const Box3 flat = { { 0, 3, 0 }, { 1, 3, 1 } };
  EXPECT_EQ(BoxTiling::grid(3, flat, { 2, 5, 2 }).count(), 4);
  EXPECT_EQ(BoxTiling::childCount(3, flat), 4);
  EXPECT_EQ(BoxTiling::tree(3, flat, { 1, -1, -1, -1, -1 }).count(), 4);
  expectMeetingAsByBruteForce(randomTree(3, flat, 4, 5));
}

TEST(BoxTiling, ADomainOfOnePointIsOneBox)
{
  const Box3 point = { { 1, 2, 3 }, { 1, 2, 3 } };
  EXPECT_EQ(BoxTiling::grid(3, point, { 2, 2, 2 }).count(), 1);
  EXPECT_EQ(BoxTiling::tree(3, point, { -1 }).count(), 1);
}

TEST(BoxTiling, TheLargestDomainIsCutWithoutOverflow)
{
  const double large = std::numeric_limits<double>::max();
  const Box3 domain = { { -large, -large, 0 }, { large, large, 0 } };
  const BoxTiling grid = BoxTiling::grid(2, domain, { 2, 4, 1 });
  EXPECT_EQ(grid.box(0).Max[0], 0.0);
  EXPECT_DOUBLE_EQ(grid.box(7).Min[1], large / 2);
  EXPECT_EQ(BoxTiling::tree(2, domain, { 1, -1, -1, -1, -1 }).box(0).Max[0], 0.0);
}

TEST(BoxTiling, MoreCutsThanDoublesGiveFlatBoxes)
{
  const Box3 domain = { { 1, 0, 0 }, { std::nextafter(1.0, 2.0), 1, 0 } };
  const BoxTiling tiling = BoxTiling::grid(2, domain, { 4, 1, 1 });
  EXPECT_EQ(tiling.count(), 4);
  EXPECT_EQ(tiling.box(0).Min[0], 1.0);
  EXPECT_EQ(tiling.box(3).Max[0], std::nextafter(1.0, 2.0));
  expectMeetingAsByBruteForce(tiling);
}

TEST(BoxTiling, RefusesAnInvalidDomain)
{
  const Box3 inverted = { { 1, 0, 0 }, { 0, 1, 0 } };
  const Box3 infinite = { { 0, 0, 0 }, { HUGE_VAL, 1, 0 } };
  const Box3 nan = { { 0, std::nan(""), 0 }, { 1, 1, 0 } };
  expectAcceleratorError(
    [&] {
      BoxTiling::grid(2, inverted, { 1, 1, 1 });
    },
    "no finite bounds along axis 0");
  expectAcceleratorError(
    [&] {
      BoxTiling::grid(2, infinite, { 1, 1, 1 });
    },
    "no finite bounds along axis 0");
  expectAcceleratorError([&] { BoxTiling::tree(2, nan, { -1 }); }, "no finite bounds along axis 1");
}

TEST(BoxTiling, RefusesAGridOfNoOrTooManyBoxes)
{
  expectAcceleratorError(
    [] {
      BoxTiling::grid(2, Square, { 0, 1, 1 });
    },
    "needs at least one along each axis, not 0");
  expectAcceleratorError(
    [] {
      BoxTiling::grid(2, Square, { 1 << 20, 1 << 20, 1 });
    },
    "fewer than 2^31 partitions");
  expectAcceleratorError([] { BoxTiling::grid(4, Square, { 1, 1, 1 }); }, "2 or 3 dimensions");
}

TEST(BoxTiling, RefusesInvalidNodes)
{
  const auto expectRefused = [](const std::vector<std::int32_t>& nodes)
  {
    expectAcceleratorError(
      [&] { BoxTiling::tree(2, Square, nodes); }, "do not make a tree of at most 24 levels");
  };
  expectRefused({});
  expectRefused({ 0 });
  expectRefused({ 1 });
  expectRefused({ 1, -1, -1, -1 });
  expectRefused({ 1, -1, -1, -1, -1, -1 });
  expectRefused({ 1, 0, -1, -1, -1 });
  expectRefused({ 1, 5, 5, -1, -1, -1, -1, -1, -1 });
  // The tree has 25 levels below the root.
  std::vector<std::int32_t> deep;
  for (std::int32_t level = 0; level < 25; ++level)
  {
    deep.insert(deep.end(), level == 0 ? 1 : 4, -1);
    deep[static_cast<std::size_t>(level == 0 ? 0 : 4 * level - 3)] = 4 * level + 1;
  }
  deep.insert(deep.end(), 4, -1);
  expectRefused(deep);
}
