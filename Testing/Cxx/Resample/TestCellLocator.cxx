// SPDX-License-Identifier: BSD-3-Clause
#include "Locate/CellLocator.h"

#include "ExactLocation.h"
#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace tipp;

namespace
{

/// The locations of points, by a locator of the cells or by a pass over the cells with a locator of
/// the points.
std::vector<CellLocation> locate(const SimplexMesh& mesh, const std::int64_t* cellIds,
  const std::vector<Point3>& points, int threads, bool byLocator)
{
  std::vector<CellLocation> locations(points.size());
  const CellLocator locator(mesh, cellIds, threads);
  locatePoints(mesh, cellIds, byLocator ? &locator : nullptr,
    { points.data(), nullptr, std::int64_t(points.size()) }, threads,
    [&](const std::int64_t* indices, const CellLocation* at, std::int64_t count)
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        locations[std::size_t(indices[i])] = at[i];
      }
    });
  return locations;
}

/// The scene's points, the middles of its edges, and random points in a larger box.
std::vector<Point3> pointsToFind(const Scene& scene, int atRandom)
{
  std::vector<Point3> points;
  for (std::size_t i = 0; i < scene.Points.size(); i += 3)
  {
    points.push_back({ scene.Points[i], scene.Points[i + 1], scene.Points[i + 2] });
  }
  for (int cell = 0; cell < scene.cells(); ++cell)
  {
    const double* a = scene.corner(cell, cell % 3);
    const double* b = scene.corner(cell, (cell + 1) % 3);
    points.push_back({ (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2 });
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-0.1, 1.1);
  for (int i = 0; i < atRandom; ++i)
  {
    points.push_back({ anywhere(random), anywhere(random), anywhere(random) });
  }
  return points;
}

/// The cells that may be returned for a point: those of the first move after which any cell
/// contains it, otherwise the closed cells that contain it.
std::vector<int> expectedCells(const Scene& scene, const Point3& point)
{
  const double sample[3] = { point.x, point.y, point.z };
  for (int move = 0; move < (scene.Dimension == 2 ? 4 : 8); ++move)
  {
    const std::vector<int> cells = oracle::cellsAfterMove(scene, sample, move);
    if (!cells.empty())
    {
      return cells;
    }
  }
  return oracle::closedCells(scene, sample);
}

void expectAsOracle(const Scene& scene, const std::vector<Point3>& points)
{
  const SimplexMesh mesh = scene.mesh();
  const std::vector<CellLocation> found = locate(mesh, nullptr, points, 2, true);
  const std::vector<CellLocation> byCells = locate(mesh, nullptr, points, 2, false);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::vector<int> expected = expectedCells(scene, points[i]);
    EXPECT_EQ(found[i].Cell, byCells[i].Cell) << scene.Name << " point " << i;
    EXPECT_EQ(found[i].Weights[1], byCells[i].Weights[1]) << scene.Name << " point " << i;
    if (expected.empty())
    {
      EXPECT_EQ(-1, found[i].Cell) << scene.Name << " point " << i;
    }
    else
    {
      EXPECT_EQ(1, std::count(expected.begin(), expected.end(), found[i].Cell))
        << scene.Name << " point " << i << ", found " << found[i].Cell;
    }
  }
}

std::vector<Scene> allScenes()
{
  std::vector<Scene> scenes = planeScenes();
  for (const Scene& scene : spaceScenes())
  {
    scenes.push_back(scene);
  }
  return scenes;
}

Scene moved(Scene scene, double factor, double by)
{
  for (double& coordinate : scene.Points)
  {
    coordinate = coordinate * factor + by;
  }
  return scene;
}

} // namespace

TEST(CellLocator, FindsTheSameCellsAsRationals)
{
  for (const Scene& scene : allScenes())
  {
    expectAsOracle(scene, pointsToFind(scene, 200));
  }
}

TEST(CellLocator, FindsCellsFarFromTheOrigin)
{
  const Scene scene = moved(jitteredScene(2, 12, 3), 0x1p-10, 0x1p22);
  std::vector<Point3> points = pointsToFind(jitteredScene(2, 12, 3), 300);
  for (Point3& p : points)
  {
    p = { p.x * 0x1p-10 + 0x1p22, p.y * 0x1p-10 + 0x1p22, 0 };
  }
  expectAsOracle(scene, points);
}

TEST(CellLocator, FindsCellsIfSinglePrecisionOverflows)
{
  const Scene scene = moved(jitteredScene(2, 8, 5), 1e300, 0);
  std::vector<Point3> points = pointsToFind(jitteredScene(2, 8, 5), 100);
  for (Point3& p : points)
  {
    p = { p.x * 1e300, p.y * 1e300, 0 };
  }
  expectAsOracle(scene, points);
}

TEST(CellLocator, AnswersDoNotDependOnTheOrderOfCells)
{
  for (const Scene& scene : { overlappingScene(60, 4), regularScene(2, 6), regularScene(3, 3) })
  {
    const Scene other = scene.shuffled(9);
    const std::vector<Point3> points = pointsToFind(scene, 300);
    const std::vector<CellLocation> one = locate(scene.mesh(), nullptr, points, 2, true);
    const std::vector<CellLocation> two = locate(other.mesh(), nullptr, points, 1, false);
    const auto cornersOf = [](const Scene& s, std::int64_t cell)
    {
      std::vector<double> corners;
      for (int i = 0; cell >= 0 && i <= s.Dimension; ++i)
      {
        corners.push_back(s.corner(int(cell), i)[0] + 3 * s.corner(int(cell), i)[1]);
      }
      std::sort(corners.begin(), corners.end());
      return corners;
    };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_EQ(cornersOf(scene, one[i].Cell), cornersOf(other, two[i].Cell)) << scene.Name << i;
    }
  }
}

TEST(CellLocator, WeightsReproduceThePoint)
{
  for (const Scene& scene : allScenes())
  {
    const std::vector<Point3> points = pointsToFind(scene, 100);
    const std::vector<CellLocation> found = locate(scene.mesh(), nullptr, points, 2, true);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      double at[3] = {};
      double sum = 0;
      for (int k = 0; found[i].Cell >= 0 && k <= scene.Dimension; ++k)
      {
        const double* corner = scene.corner(int(found[i].Cell), k);
        sum += found[i].Weights[k];
        for (int axis = 0; axis < 3; ++axis)
        {
          at[axis] += found[i].Weights[k] * corner[axis];
        }
      }
      if (found[i].Cell >= 0)
      {
        EXPECT_NEAR(1, sum, 1e-12);
        EXPECT_NEAR(points[i].x, at[0], 1e-12) << scene.Name;
        EXPECT_NEAR(points[i].y, at[1], 1e-12) << scene.Name;
        EXPECT_TRUE(scene.Dimension == 2 || std::fabs(points[i].z - at[2]) < 1e-12) << scene.Name;
      }
    }
  }
}

TEST(CellLocator, CellsThatAreInfiniteOrHiddenContainNothing)
{
  Scene scene = regularScene(2, 2);
  const std::vector<Point3> points = pointsToFind(scene, 200);
  for (const double bad : { std::nan(""), double(INFINITY) })
  {
    Scene damaged = scene;
    damaged.Points[3 * std::size_t(damaged.Ids[0])] = bad;
    for (const CellLocation& found : locate(damaged.mesh(), nullptr, points, 2, true))
    {
      for (int i = 0; found.Cell >= 0 && i < 3; ++i)
      {
        EXPECT_TRUE(std::isfinite(damaged.corner(int(found.Cell), i)[0]));
      }
    }
  }
  SimplexMesh mesh = scene.mesh();
  const std::vector<unsigned char> hidden(std::size_t(scene.cells()), 1);
  mesh.Hidden = hidden.data();
  for (const CellLocation& found : locate(mesh, nullptr, points, 1, false))
  {
    EXPECT_EQ(-1, found.Cell);
  }
}

TEST(CellLocator, PointsThatAreNotFiniteAreOutside)
{
  const Scene scene = regularScene(3, 2);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const CellLocation& found : locate(scene.mesh(), nullptr,
         { { std::nan(""), 0.5, 0.5 }, { 0.5, infinity, 0.5 }, { 0.5, 0.5, -infinity } }, 1, true))
  {
    EXPECT_EQ(-1, found.Cell);
  }
}

TEST(CellLocator, AMeshWithoutCellsContainsNothing)
{
  Scene scene = regularScene(2, 2);
  scene.Ids.clear();
  EXPECT_EQ(-1, locate(scene.mesh(), nullptr, { { 0.5, 0.5, 0 } }, 1, true)[0].Cell);
  EXPECT_TRUE(locate(scene.mesh(), nullptr, {}, 2, false).empty());
}

TEST(CellLocator, TheLowestIdOfEqualCellsIsFound)
{
  Scene scene = regularScene(2, 1);
  const std::vector<std::int64_t> ids = scene.Ids;
  scene.Ids.insert(scene.Ids.end(), ids.begin(), ids.end());
  const std::vector<std::int64_t> cellIds = { 7, 8, 3, 9 };
  for (const Point3& p : pointsToFind(scene, 50))
  {
    const std::int64_t cell = locate(scene.mesh(), cellIds.data(), { p, p, p }, 1, false)[1].Cell;
    EXPECT_TRUE(cell == -1 || cell == 2 || cell == 1) << cell;
  }
}
