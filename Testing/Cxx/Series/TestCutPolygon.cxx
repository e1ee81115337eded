// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CutPolygon.h"
#include "Predicates/ExactPredicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using Polygon = std::vector<Point2>;
using Positions = std::set<std::pair<double, double>>;

double areaOf(Point2 a, Point2 b, Point2 c)
{
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
}

double areaOf(const Polygon& polygon)
{
  double area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
  {
    area += areaOf(polygon[0], polygon[i], polygon[i + 1]);
  }
  return std::fabs(area);
}

/// The triangles as sets of positions. Expects that they are one fewer than the corners less one,
/// counter-clockwise, and cover the polygon's area.
std::set<Positions> cut(const Polygon& polygon)
{
  std::vector<CornerTriangle> triangles;
  EXPECT_TRUE(cutPolygon(polygon, triangles));
  EXPECT_EQ(polygon.size() - 2, triangles.size());
  std::set<Positions> cut;
  double area = 0;
  for (const CornerTriangle& t : triangles)
  {
    EXPECT_GT(orientation(polygon[t[0]], polygon[t[1]], polygon[t[2]]), 0);
    area += areaOf(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    Positions corners;
    for (const std::size_t corner : t)
    {
      corners.insert({ polygon[corner].x, polygon[corner].y });
    }
    cut.insert(corners);
  }
  EXPECT_NEAR(areaOf(polygon), area, 1e-9 * area);
  return cut;
}

/// Expects the same triangles from every first corner, in both directions.
void expectSymmetric(Polygon polygon)
{
  const std::set<Positions> expected = cut(polygon);
  for (int direction = 0; direction < 2; ++direction)
  {
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      EXPECT_EQ(expected, cut(polygon));
    }
    std::reverse(polygon.begin(), polygon.end());
  }
}

TEST(CutPolygon, SquaresAreCutAlikeWhateverTheirFirstCorner)
{
  expectSymmetric({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } });
}

TEST(CutPolygon, RegularPolygonsAreCutAlike)
{
  expectSymmetric({ { 2, 0 }, { 1, 2 }, { -1, 2 }, { -2, 0 }, { -1, -2 }, { 1, -2 } });
}

TEST(CutPolygon, ConcavePolygonsAreCutInside)
{
  expectSymmetric({ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 2, 1 } });
  expectSymmetric(
    { { 0, 0 }, { 5, 0 }, { 5, 3 }, { 4, 3 }, { 4, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } });
}

TEST(CutPolygon, CornersOnStraightEdgesMakeNoFlatTriangles)
{
  expectSymmetric({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } });
  expectSymmetric({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 0, 3 } });
  expectSymmetric(
    { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 }, { 2, 2 }, { 1, 2 }, { 0, 2 }, { 0, 1 } });
}

TEST(CutPolygon, StarsOfRandomRadiusAreCutAlike)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.1, 1);
  for (std::size_t size = 4; size < 14; ++size)
  {
    Polygon star;
    for (std::size_t i = 0; i < size; ++i)
    {
      const double angle = 6.283185307179586 * double(i) / double(size);
      const double r = radius(random);
      star.push_back({ r * std::cos(angle), r * std::sin(angle) });
    }
    expectSymmetric(star);
  }
}

TEST(CutPolygon, PolygonsThatCrossOrTouchThemselvesAreRefused)
{
  std::vector<CornerTriangle> none;
  EXPECT_FALSE(cutPolygon({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } }, none)); // a bow
  EXPECT_FALSE(
    cutPolygon({ { 0, 0 }, { 1, 0 }, { 1, 0 }, { 0, 1 } }, none)); // an edge of no length
  EXPECT_FALSE(cutPolygon({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 } }, none)); // no area
  EXPECT_FALSE(cutPolygon({ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 2, 0 } }, none)); // a corner on an edge
  EXPECT_FALSE(
    cutPolygon({ { 0, 0 }, { 4, 0 }, { 2, 0 }, { 2, 4 } }, none)); // an edge that turns back
  EXPECT_FALSE(
    cutPolygon({ { 0, 3 }, { -2, -3 }, { 3, 1 }, { -3, 1 }, { 2, -3 } }, none)); // a star
  EXPECT_FALSE(cutPolygon({ { 0, 0 }, { 1, 0 } }, none));
  EXPECT_FALSE(cutPolygon(Polygon(mostCorners + 1), none));
  EXPECT_TRUE(none.empty());
}

} // namespace
