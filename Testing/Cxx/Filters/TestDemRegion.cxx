// SPDX-License-Identifier: BSD-3-Clause
// Whether the pixels of a raster are known from the points of a region.
#include "Dem/DemRegion.h"

#include "Arrays/Random.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/Triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace
{

using namespace tipp;

using Corners = std::array<Point2, 3>;

/// Points without duplicates: random ones, or those of a lattice, with all ties of cocircular
/// points.
std::vector<double> makePoints(bool isLattice, std::uint64_t seed)
{
  constexpr int side = 45;
  Random random(seed);
  std::vector<double> xy;
  for (int i = 0; i < side * side; ++i)
  {
    xy.push_back(isLattice ? double(i % side) / side : random.uniform());
    xy.push_back(isLattice ? double(i / side) / side : random.uniform());
  }
  return xy;
}

std::vector<double> pointsIn(const Box2& box, const std::vector<double>& xy)
{
  std::vector<double> inside;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    if (box.contains(Point2{ xy[i], xy[i + 1] }))
    {
      inside.insert(inside.end(), { xy[i], xy[i + 1] });
    }
  }
  return inside;
}

/// Returns the triangle that has a pixel's centre strictly inside; nullopt: there is none.
std::optional<Corners> triangleAt(PointsView points, const Triangulation& mesh, Point2 centre)
{
  for (std::size_t t = 0; t < mesh.Ids32.size(); t += 3)
  {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      corners[i] = points[std::size_t(mesh.Ids32[t + i])];
    }
    if (orientation(corners[0], corners[1], centre) > 0 &&
      orientation(corners[1], corners[2], centre) > 0 &&
      orientation(corners[2], corners[0], centre) > 0)
    {
      std::sort(corners.begin(), corners.end(),
        [](Point2 a, Point2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
      return corners;
    }
  }
  return std::nullopt;
}

/// Whether all pixels are in the same triangles of both triangulations.
bool areSame(PointsView all, const Triangulation& ofAll, PointsView part,
  const Triangulation& ofPart, const RasterGrid& grid)
{
  for (std::int64_t row = 0; row < grid.Rows; ++row)
  {
    for (std::int64_t column = 0; column < grid.Columns; ++column)
    {
      const Point2 centre{ grid.West + grid.Pixel[0] * (double(column) + 0.5),
        grid.South + grid.Pixel[1] * (double(row) + 0.5) };
      const auto expected = triangleAt(all, ofAll, centre);
      const auto found = triangleAt(part, ofPart, centre);
      if (expected.has_value() != found.has_value() ||
        (expected &&
          !std::equal(expected->begin(), expected->end(), found->begin(),
            [](Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; })))
      {
        return false;
      }
    }
  }
  return true;
}

TEST(DemRegion, KnownPixelsAreThoseOfAllPoints)
{
  int known = 0;
  int wrongUnlessAsked = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
  {
    const std::vector<double> xy = makePoints(seed % 3 == 2, seed);
    const PointsView all(xy.data(), xy.size() / 2, 2);
    const Triangulation ofAll = triangulate(all);
    Random random(seed + 1000);
    RasterGrid grid;
    grid.West = random.uniform(0.02, 0.85);
    grid.South = random.uniform(0.02, 0.85);
    grid.Pixel = { 0.017, 0.013 };
    grid.Columns = 6;
    grid.Rows = 8;
    for (const double margin : { 0.001, 0.02, 0.06, 0.15 })
    {
      const Box2 region{ { grid.West - margin, grid.South - margin },
        { grid.West + 0.102 + margin, grid.South + 0.104 + margin } };
      const std::vector<double> inside = pointsIn(region, xy);
      const PointsView part(inside.data(), inside.size() / 2, 2);
      const Triangulation ofPart = triangulate(part);
      const bool isRight = areSame(all, ofAll, part, ofPart, grid);
      if (isKnown(part, ofPart, grid, region, 1 + int(seed % 3)))
      {
        ++known;
        EXPECT_TRUE(isRight) << "seed " << seed << ", margin " << margin;
      }
      wrongUnlessAsked += isRight ? 0 : 1;
    }
  }
  EXPECT_GT(known, 60);
  EXPECT_GT(wrongUnlessAsked, 30);
}

/// A point far away may lie in the circumdisk of a triangle at the edge of a gap.
TEST(DemRegion, TrianglesAcrossAGapAreNotKnown)
{
  const std::vector<double> xy = { 0, 0, 1, 0, 0, 1, 1, 1, 0.5, 0.1, 0.5, 0.9 };
  const PointsView points(xy.data(), xy.size() / 2, 2);
  RasterGrid grid;
  grid.West = grid.South = 0.4;
  grid.Pixel = { 0.1, 0.1 };
  grid.Columns = grid.Rows = 2;
  const Triangulation mesh = triangulate(points);
  EXPECT_FALSE(isKnown(points, mesh, grid, { { 0, 0 }, { 1, 1 } }, 1));
  EXPECT_TRUE(isKnown(points, mesh, grid, { { -9, -9 }, { 9, 9 } }, 1));
}

TEST(DemRegion, PixelsOutsideOfTheTrianglesAreNotKnown)
{
  const std::vector<double> xy = { 0, 0, 1, 0, 0, 1 };
  const PointsView points(xy.data(), xy.size() / 2, 2);
  RasterGrid grid;
  grid.West = grid.South = 0.6;
  grid.Pixel = { 0.1, 0.1 };
  grid.Columns = grid.Rows = 2;
  EXPECT_FALSE(isKnown(points, triangulate(points), grid, { { -9, -9 }, { 9, 9 } }, 1));
}

} // namespace
