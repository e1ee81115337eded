// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Files/IOError.h"
#include "Query/Queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// A lattice over the unit square with values height(x, y).
template <typename Height>
SourceMesh terrain(int n, double jitter, const Height& height)
{
  SourceMesh source = makeSource(latticeTriangles(n, jitter));
  for (std::size_t i = 0; i < source.points(); ++i)
  {
    const Point3 p = pointOf(source, std::int64_t(i));
    source.Values[2 * i] = float(height(p.x, p.y));
  }
  return source;
}

double hills(double x, double y)
{
  return std::sin(9 * x + 0.5) * std::cos(7 * y) + 0.3 * x; // the values vary along all sides
}

std::vector<Point3> starts(int n)
{
  std::vector<Point3> points;
  for (int i = 0; i < n; ++i)
  {
    points.push_back({ std::fmod(0.618034 * i, 1.0), std::fmod(0.754878 * i, 1.0), 0 });
  }
  return points;
}

} // namespace

TEST(Descent, EndsAtAPointWithoutALowerNeighbor)
{
  const SourceMesh source = terrain(24, 0.3, hills);
  const ResidentMesh mesh(inMemory(source));
  const std::vector<Point3> points = starts(200);
  const Descents lines = descentsOf(mesh, points, "value", 0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ASSERT_LT(lines.Starts[i], lines.Starts[i + 1]);
    EXPECT_EQ(points[i].x, lines.Points[std::size_t(lines.Starts[i])].x);
    for (std::int64_t k = lines.Starts[i] + 1; k < lines.Starts[i + 1]; ++k)
    {
      EXPECT_LE(lines.Values[std::size_t(k)], lines.Values[std::size_t(k - 1)]);
    }
    ASSERT_LE(0, lines.Pits[i]);
    const Point3 end = pointOf(source, lines.Pits[i]);
    EXPECT_EQ(end.x, lines.Points[std::size_t(lines.Starts[i + 1] - 1)].x);
    const IdLists ring = ringsOfPoints(mesh, { lines.Pits[i] }, 1);
    for (const std::int64_t other : ring.Ids)
    {
      EXPECT_LE(
        source.Values[2 * std::size_t(lines.Pits[i])], source.Values[2 * std::size_t(other)]);
    }
  }
}

TEST(Descent, FollowsTheGradientInTriangles)
{
  const SourceMesh source = terrain(24, 0.3, hills);
  const ResidentMesh mesh(inMemory(source));
  const Descents lines = descentsOf(mesh, starts(50), "value", 0);
  AnswerOptions options;
  options.Arrays = { "value" };
  int across = 0;
  for (std::size_t i = 0; i + 1 < lines.Points.size(); ++i)
  {
    if (std::binary_search(lines.Starts.begin(), lines.Starts.end(), std::int64_t(i + 1)))
    {
      continue;
    }
    const Point3& a = lines.Points[i];
    const Point3& b = lines.Points[i + 1];
    const Point3 middle{ (a.x + b.x) / 2, (a.y + b.y) / 2, 0 };
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const MeshAnswer at = mesh.answer(&middle, 1, options);
    ASSERT_LE(0, at.Cells[0]);
    // A line within one triangle has the mesh's values.
    EXPECT_NEAR((lines.Values[i] + lines.Values[i + 1]) / 2,
      double(at.Arrays[0].Values.as<float>()[0]), 1e-6);
    // Inside a triangle, no other direction descends faster.
    const double step = 1e-3 * length;
    Point3 sides[2];
    for (int s = 0; s < 2; ++s)
    {
      const double turn = s == 0 ? 0.3 : -0.3;
      const double dx = (b.x - a.x) / length;
      const double dy = (b.y - a.y) / length;
      sides[s] = { middle.x + step * (dx * std::cos(turn) - dy * std::sin(turn)),
        middle.y + step * (dx * std::sin(turn) + dy * std::cos(turn)), 0 };
    }
    const MeshAnswer beside = mesh.answer(sides, 2, options);
    if (length < 0.005 || beside.Cells[0] != at.Cells[0] || beside.Cells[1] != at.Cells[0])
    {
      continue;
    }
    ++across;
    const double slope = (lines.Values[i] - lines.Values[i + 1]) / length;
    for (int s = 0; s < 2; ++s)
    {
      const double fall = double(at.Arrays[0].Values.as<float>()[0]) -
        double(beside.Arrays[0].Values.as<float>()[2 * s]);
      EXPECT_LT(fall / step, slope * 0.99 + 0.05);
    }
  }
  EXPECT_LT(50, across);
}

TEST(Descent, OnAPlaneIsStraightAndThenFollowsTheBorder)
{
  const SourceMesh source = terrain(10, 0, [](double x, double y) { return 2 * x + y; });
  const ResidentMesh mesh(inMemory(source));
  const Descents lines = descentsOf(mesh, { { 0.35, 0.93, 0 }, { 5, 5, 0 } }, "value", 0);
  ASSERT_EQ(lines.Starts[1], lines.Starts[2]); // the second point is outside the mesh
  EXPECT_EQ(-1, lines.Pits[1]);
  const Point3 pit = pointOf(source, lines.Pits[0]);
  EXPECT_EQ(0, pit.x + pit.y);
  for (const Point3& p : lines.Points)
  {
    // Down in direction (-2, -1) to x = 0, then along this border.
    EXPECT_NEAR(p.x > 1e-5 ? 0.93 - 0.5 * (0.35 - p.x) : p.y, p.y, 1e-5);
  }
}

TEST(Descent, EndsWhereTheMeshIsLevel)
{
  const SourceMesh source = terrain(6, 0.2, [](double, double) { return 3; });
  const ResidentMesh mesh(inMemory(source));
  const Descents lines = descentsOf(mesh, { { 0.512, 0.487, 0 } }, "value", 0);
  EXPECT_EQ(1U, lines.Points.size());
  EXPECT_EQ(-1, lines.Pits[0]);
}

TEST(Descent, IsTheSameForAnyPieces)
{
  for (const double jitter : { 0.3, 0.0 })
  {
    const SourceMesh source = terrain(20, jitter, hills);
    std::vector<Point3> points = starts(100);
    points.push_back(pointOf(source, source.Cells[7]));
    points.push_back({ 0.25, 0.5, 0 });
    const Descents expected = descentsOf(ResidentMesh(inMemory(source)), points, "value", 0);
    withEachMesh(source,
      [&](const ResidentMesh& mesh)
      {
        const Descents lines = descentsOf(mesh, points, "value", 0);
        EXPECT_EQ(expected.Starts, lines.Starts);
        EXPECT_EQ(expected.Points, lines.Points);
        EXPECT_EQ(expected.Values, lines.Values);
        EXPECT_EQ(expected.Pits, lines.Pits);
      });
  }
}

TEST(Descent, RefusesTetrahedraAndArraysOfCells)
{
  const ResidentMesh tetrahedra(inMemory(makeSource(latticeTetrahedra(2, 0))));
  EXPECT_THROW(descentsOf(tetrahedra, {}, "value", 0), IOError);
  const ResidentMesh triangles(inMemory(makeSource(latticeTriangles(2, 0))));
  EXPECT_THROW(descentsOf(triangles, {}, "label", 0), IOError);
}
