// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/HolePoints.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace
{

using namespace tipp;

/// A grid of unit squares, each of two triangles, without those that `isHole` names.
struct Grid
{
  template <typename IsHole>
  Grid(int size, const IsHole& isHole)
  {
    const int side = size + 1;
    for (int i = 0; i < side * side; ++i)
    {
      this->XY.insert(this->XY.end(), { double(i % side), double(i / side) });
    }
    const auto covers = [&](int x, int y)
    { return x >= 0 && y >= 0 && x < size && y < size && !isHole(x, y); };
    const auto node = [side](int x, int y) { return std::int32_t(y * side + x); };
    for (int y = 0; y <= size; ++y)
    {
      for (int x = 0; x <= size; ++x)
      {
        if (covers(x, y))
        {
          this->Ids.insert(this->Ids.end(),
            { node(x, y), node(x + 1, y), node(x + 1, y + 1), node(x, y), node(x + 1, y + 1),
              node(x, y + 1) });
        }
        if (covers(x, y) != covers(x, y - 1))
        {
          this->Segments.push_back({ node(x, y), node(x + 1, y) });
        }
        if (covers(x, y) != covers(x - 1, y))
        {
          this->Segments.push_back({ node(x, y), node(x, y + 1) });
        }
      }
    }
  }

  HolePoints holes() const
  {
    PointTable points;
    points.XY = this->XY;
    return findHolePoints(
      points, TrianglesView(this->Ids.data(), this->Ids.size() / 3), this->Segments);
  }

  std::vector<double> XY;
  std::vector<std::int32_t> Ids;
  std::vector<std::array<std::int64_t, 2>> Segments;
};

TEST(HolePoints, AMeshWithoutHolesHasNone)
{
  const HolePoints holes = Grid(3, [](int, int) { return false; }).holes();
  EXPECT_TRUE(holes.Points.empty());
  EXPECT_EQ(holes.TooThin, 0);
}

TEST(HolePoints, EachHoleHasOnePointInside)
{
  const auto isHole = [](int x, int y)
  { return (x == 1 && y <= 2 && y >= 1) || (x == 4 && y == 3); };
  const HolePoints holes = Grid(6, isHole).holes();
  ASSERT_EQ(holes.Points.size(), 2U);
  for (const Point2 p : holes.Points)
  {
    EXPECT_TRUE(isHole(int(std::floor(p.x)), int(std::floor(p.y)))) << p.x << ' ' << p.y;
  }
  EXPECT_NE(holes.Points[0].x < 3, holes.Points[1].x < 3);
}

TEST(HolePoints, HolesThatTouchAtANodeAreTwo)
{
  const auto isHole = [](int x, int y) { return (x == 1 && y == 1) || (x == 2 && y == 2); };
  const HolePoints holes = Grid(4, isHole).holes();
  ASSERT_EQ(holes.Points.size(), 2U);
  EXPECT_NE(holes.Points[0].x < 2, holes.Points[1].x < 2);
}

TEST(HolePoints, AHoleAroundAnIslandHasItsPointBesideTheIsland)
{
  const auto isHole = [](int x, int y)
  { return x >= 1 && x <= 3 && y >= 1 && y <= 3 && !(x == 2 && y == 2); };
  const HolePoints holes = Grid(5, isHole).holes();
  ASSERT_EQ(holes.Points.size(), 1U);
  EXPECT_TRUE(isHole(int(std::floor(holes.Points[0].x)), int(std::floor(holes.Points[0].y))));
}

} // namespace
