// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Tiling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace
{

using namespace tipp;

class CellGridTest : public testing::TestWithParam<Instructions>
{
public:
  static std::vector<std::uint32_t> find(const CellGrid& grid, const std::vector<Point2>& points)
  {
    std::vector<std::uint32_t> cells(points.size());
    grid.find(points.data(), points.size(), cells.data(), GetParam());
    return cells;
  }
};

TEST_P(CellGridTest, CellsAreNumberedRowByRow)
{
  const CellGrid grid({ 0, 0, 3, 6 }, 3);
  std::vector<Point2> middles;
  std::vector<std::uint32_t> expected;
  for (std::uint32_t cell = 0; cell < 9; ++cell)
  {
    middles.push_back({ cell % 3 + 0.5, 2 * double(cell / 3) + 1 });
    expected.push_back(cell);
  }
  EXPECT_EQ(expected, find(grid, middles));
}

TEST_P(CellGridTest, PointsBeyondTheBoxAreAtItsBorder)
{
  const CellGrid grid({ 0, 0, 3, 3 }, 3);
  EXPECT_EQ((std::vector<std::uint32_t>{ 0, 2, 6, 8, 3 }),
    find(grid, { { -9, -1e300 }, { 9, -9 }, { -9, 1e300 }, { 1e300, 3 }, { -1, 1.5 } }));
}

TEST_P(CellGridTest, PointsThatAreNotFiniteAreInTheCellAfterTheLast)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const CellGrid grid({ 0, 0, 3, 3 }, 3);
  EXPECT_EQ((std::vector<std::uint32_t>{ 9, 9, 9, 9, 4 }),
    find(grid, { { nan, 1 }, { 1, nan }, { HUGE_VAL, 1 }, { 1, -HUGE_VAL }, { 1.5, 1.5 } }));
}

TEST_P(CellGridTest, CellIndicesRiseWithTheCoordinate)
{
  const CellGrid grid({ 0.1, 0, 0.7, 1 }, 1000);
  std::vector<Point2> points;
  for (double x = 0.1; x < 0.1 + 1e-14; x = std::nextafter(x, 1))
  {
    points.push_back({ x, 0.5 });
    points.push_back({ x + 0.3, 0.5 });
  }
  std::sort(
    points.begin(), points.end(), [](Point2 a, Point2 b) { return lexicographicLess(a, b); });
  const std::vector<std::uint32_t> cells = find(grid, points);
  EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
}

TEST_P(CellGridTest, ABoxWithoutExtentHasOneColumnOrRow)
{
  const CellGrid grid({ 2, 0, 2, 1 }, 4);
  EXPECT_EQ(4U, grid.size());
  EXPECT_EQ((std::vector<std::uint32_t>{ 0, 3 }), find(grid, { { 2, 0 }, { 2, 0.9 } }));
}

INSTANTIATE_TEST_SUITE_P(With, CellGridTest,
  testing::Values(Instructions::Common, Instructions::Best),
  [](const auto& info)
  { return info.param == Instructions::Common ? "CommonInstructions" : "BestInstructions"; });

} // namespace
