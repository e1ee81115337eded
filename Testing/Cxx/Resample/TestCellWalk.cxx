// SPDX-License-Identifier: BSD-3-Clause
#include "Locate/CellLocator.h"

#include "Locate/CellChoice.h"
#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

using namespace tipp;

namespace
{

bool isUsable(const Scene& scene)
{
  const bool answer = CellWalk(scene.mesh(), 1).isUsable();
  EXPECT_EQ(answer, CellWalk(scene.mesh(), 3).isUsable()) << scene.Name;
  return answer;
}

/// Appends a copy of a mesh with its own points, scaled and then moved by (x, y).
void append(Scene& to, const Scene& scene, double x, double y, double factor)
{
  const auto first = std::int64_t(to.Points.size() / 3);
  for (std::size_t i = 0; i < scene.Points.size(); i += 3)
  {
    to.Points.insert(to.Points.end(),
      { scene.Points[i] * factor + x, scene.Points[i + 1] * factor + y, scene.Points[i + 2] });
  }
  for (const std::int64_t id : scene.Ids)
  {
    to.Ids.push_back(first + id);
  }
}

/// A strip of triangles that winds around the origin `turns` times.
Scene windingScene(double turns)
{
  Scene scene;
  const int steps = 20;
  for (int i = 0; i <= steps; ++i)
  {
    const double angle = 2 * 3.141592653589793 * turns * i / steps;
    for (const double radius : { 1.0, 2.0 })
    {
      scene.Points.insert(
        scene.Points.end(), { radius * std::cos(angle), radius * std::sin(angle), 0 });
    }
    for (int k = 0; k < 2 && i < steps; ++k)
    {
      const std::int64_t a = 2 * i;
      k == 0 ? scene.Ids.insert(scene.Ids.end(), { a, a + 1, a + 3 })
             : scene.Ids.insert(scene.Ids.end(), { a, a + 3, a + 2 });
    }
  }
  return scene;
}

/// Removes the triangles whose first corner is inside a disk.
Scene withHole(Scene scene, double x, double y, double radius)
{
  std::vector<std::int64_t> ids;
  for (int cell = 0; cell < scene.cells(); ++cell)
  {
    const double* const p = scene.corner(cell, 0);
    if (std::hypot(p[0] - x, p[1] - y) > radius)
    {
      ids.insert(ids.end(), scene.Ids.begin() + 3 * cell, scene.Ids.begin() + 3 * cell + 3);
    }
  }
  scene.Ids = ids;
  return scene;
}

Scene turned(Scene scene)
{
  for (std::size_t i = 0; i < scene.Ids.size(); i += 3)
  {
    std::swap(scene.Ids[i], scene.Ids[i + 1]);
  }
  return scene;
}

/// Many points in and around the unit square, in rows or at random.
std::vector<Point3> manyPoints(bool inRows)
{
  std::vector<Point3> points;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-0.1, 1.1);
  for (int i = 0; i < 4000; ++i)
  {
    inRows ? points.push_back({ (i % 80) / 64.0 - 0.125, i / 80 / 40.0 - 0.125, 0 })
           : points.push_back({ anywhere(random), anywhere(random), 0 });
  }
  return points;
}

std::vector<std::int64_t> located(
  const SimplexMesh& mesh, const std::vector<Point3>& points, bool byLocator, int threads)
{
  std::vector<std::int64_t> cells(points.size(), -1);
  const CellLocator locator(mesh, nullptr, threads);
  locatePoints(mesh, nullptr, byLocator ? &locator : nullptr,
    { points.data(), nullptr, std::int64_t(points.size()) }, threads,
    [&](const std::int64_t* indices, const CellLocation* at, std::int64_t count)
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        cells[std::size_t(indices[i])] = at[i].Cell;
      }
    });
  return cells;
}

} // namespace

TEST(CellWalk, IsUsableIfNoTrianglesOverlap)
{
  Scene apart = jitteredScene(2, 9, 1);
  append(apart, jitteredScene(2, 9, 2), 1.5, 0, 1);
  Scene inHole = withHole(jitteredScene(2, 20, 3), 0.5, 0.5, 0.3);
  EXPECT_TRUE(isUsable(inHole));
  append(inHole, jitteredScene(2, 9, 2), 0.4, 0.4, 0.2);
  Scene oneTurned = windingScene(0.9);
  std::swap(oneTurned.Ids[30], oneTurned.Ids[31]);
  for (const Scene& scene : { regularScene(2, 12), jitteredScene(2, 12, 3), apart, inHole,
         windingScene(0.9), turned(jitteredScene(2, 12, 3)), oneTurned })
  {
    EXPECT_TRUE(isUsable(scene));
  }
}

TEST(CellWalk, IsNotUsableIfTrianglesOverlap)
{
  Scene overCorner = jitteredScene(2, 9, 1);
  append(overCorner, jitteredScene(2, 9, 2), 0.9, 0.9, 1);
  Scene inside = jitteredScene(2, 9, 1);
  append(inside, regularScene(2, 1), 0.42, 0.43, 0.01);
  Scene around = regularScene(2, 1);
  append(around, jitteredScene(2, 9, 2), 0.45, 0.45, 0.1);
  Scene twice = jitteredScene(2, 9, 1);
  append(twice, jitteredScene(2, 9, 1), 0, 0, 1);
  Scene sameIds = jitteredScene(2, 9, 1);
  sameIds.Ids.insert(sameIds.Ids.end(), sameIds.Ids.begin(), sameIds.Ids.begin() + 3);
  for (const Scene& scene : { overCorner, inside, around, twice, sameIds, windingScene(1.3),
         windingScene(2), overlappingScene(50, 1) })
  {
    EXPECT_FALSE(isUsable(scene));
  }
}

TEST(CellWalk, FindsTheSameCellsAsAPassOverAllCells)
{
  Scene clusters = withHole(regularScene(2, 40), 0.4, 0.6, 0.2);
  append(clusters, jitteredScene(2, 30, 4), 0.3, 0.5, 0.1);
  for (const Scene& scene : { regularScene(2, 32), jitteredScene(2, 40, 1), clusters,
         turned(withHole(jitteredScene(2, 25, 2), 0.5, 0.1, 0.3)), windingScene(0.9) })
  {
    for (const bool inRows : { true, false })
    {
      const std::vector<Point3> points = manyPoints(inRows);
      const std::vector<std::int64_t> expected = located(scene.mesh(), points, false, 1);
      EXPECT_EQ(expected, located(scene.mesh(), points, true, 1));
      EXPECT_EQ(expected, located(scene.mesh(), points, true, 3));
    }
  }
}

TEST(CellWalk, RecognizesPointsOutsideAConvexMesh)
{
  const Scene hollow = withHole(jitteredScene(2, 20, 3), 0.5, 0.5, 0.3);
  const Scene notched = withHole(jitteredScene(2, 20, 3), 0, 0, 0.2);
  const Scene square = jitteredScene(2, 20, 3);
  for (const Scene* const scene : { &square, &hollow, &notched })
  {
    const SimplexMesh mesh = scene->mesh();
    const CellWalk walk(mesh, 1);
    ASSERT_TRUE(walk.isUsable());
    withAccess(mesh,
      [&](const auto& access)
      {
        if constexpr (std::decay_t<decltype(access)>::Dimension == 2)
        {
          CellWalk::Position at;
          const auto expected =
            scene == &square ? CellWalk::Outcome::Outside : CellWalk::Outcome::Unknown;
          EXPECT_EQ(expected, walk.walk(access, { 1.5, 0.7 }, at));
          EXPECT_EQ(expected, walk.walk(access, { 0.3, -1e-9 }, at));
          EXPECT_EQ(CellWalk::Outcome::Unknown, walk.walk(access, { 1, 0.7 }, at));
        }
      });
  }
}

TEST(CellWalk, NeedsFewStepsFromPointToPoint)
{
  const Scene scene = jitteredScene(2, 200, 1);
  const SimplexMesh mesh = scene.mesh();
  const CellWalk walk(mesh, 2);
  ASSERT_TRUE(walk.isUsable());
  withAccess(mesh,
    [&](const auto& access)
    {
      if constexpr (std::decay_t<decltype(access)>::Dimension == 2)
      {
        CellWalk::Position at;
        for (int i = 0; i < 1000; ++i) // points next to each other, and some far away
        {
          const bool isFar = i % 100 == 0;
          const Point2 point{ 0.05 + 0.0008 * i + (isFar ? 0.1 : 0), isFar ? 0.9 : 0.3 };
          EXPECT_EQ(CellWalk::Outcome::Found, walk.walk(access, point, at));
        }
        EXPECT_GT(4000, at.Steps);
      }
    });
}
