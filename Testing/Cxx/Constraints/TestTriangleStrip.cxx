// SPDX-License-Identifier: BSD-3-Clause
// The triangles that one segment crosses, retriangulated without a mesh.
#include "Constraints/ConstraintRegion.h"
#include "Constraints/TriangleStrip.h"
#include "Triangulation/Triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <set>
#include <vector>

namespace
{

using namespace tipp;

using Corners = std::array<PointId, 3>;

Corners fromLowest(Corners corners)
{
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<Point2> randomPoints(std::size_t count)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 1);
  std::vector<Point2> points(count);
  for (Point2& p : points)
  {
    p = { anywhere(random), anywhere(random) };
  }
  return points;
}

/// The Delaunay triangles that the segment between points a and b crosses.
std::vector<LocatedTriangle> crossedTriangles(
  const std::vector<Point2>& points, PointId a, PointId b)
{
  const Triangulation mesh = triangulate(PointsView(points), {});
  const auto at = [&](PointId id) { return points[std::size_t(id)]; };
  std::vector<LocatedTriangle> crossed;
  for (std::size_t t = 0; t < mesh.Ids32.size(); t += 3)
  {
    const Corners ids{ mesh.Ids32[t], mesh.Ids32[t + 1], mesh.Ids32[t + 2] };
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (crossProperly(at(a), at(b), at(ids[i]), at(ids[(i + 1) % 3])))
      {
        crossed.push_back({ ids, { at(ids[0]), at(ids[1]), at(ids[2]) } });
        break;
      }
    }
  }
  return crossed;
}

const auto noConstraint = [](PointId, PointId) { return false; };

std::set<Corners> withStrip(const std::vector<LocatedTriangle>& triangles, PointId a, PointId b)
{
  TriangleStrip strip;
  strip.follow(triangles.data(), triangles.size(), a, b, noConstraint);
  std::set<Corners> all;
  strip.triangulate([&](const Corners& corners) { all.insert(fromLowest(corners)); });
  return all;
}

std::set<Corners> withMesh(const std::vector<LocatedTriangle>& triangles, PointId a, PointId b)
{
  ConstraintRegion region;
  region.clear();
  for (const LocatedTriangle& triangle : triangles)
  {
    region.add(triangle.Ids, triangle.Positions);
  }
  region.finish();
  region.insert(a, b);
  std::set<Corners> all;
  for (std::size_t t = 0; t < region.triangleCount(); ++t)
  {
    all.insert(fromLowest(region.triangle(t)));
  }
  return all;
}

TEST(TriangleStrip, ItsTrianglesAreThoseOfAMesh)
{
  const std::vector<Point2> points = randomPoints(400);
  for (PointId b = 1; b < 100; ++b)
  {
    const std::vector<LocatedTriangle> crossed = crossedTriangles(points, 0, b);
    if (!crossed.empty())
    {
      EXPECT_EQ(withMesh(crossed, 0, b), withStrip(crossed, 0, b)) << "to point " << b;
    }
  }
}

TEST(TriangleStrip, PointsOfALatticeFollowTheTieRule)
{
  constexpr PointId side = 12;
  std::vector<Point2> points;
  for (PointId i = 0; i < side * side; ++i)
  {
    points.push_back({ double(i % side), double(i / side) });
  }
  for (const PointId b : { 7 + 5 * side, 11 + 10 * side, 1 + 11 * side, 11 + side })
  {
    const std::vector<LocatedTriangle> crossed = crossedTriangles(points, 0, b);
    ASSERT_GT(crossed.size(), 2U);
    EXPECT_EQ(withMesh(crossed, 0, b), withStrip(crossed, 0, b)) << "to point " << b;
  }
}

TEST(TriangleStrip, AnEdgeWhoseTrianglesAreBothCrossedIsKept)
{
  // The segment from 0 to 1 crosses all triangles, but not the edge from 2 to 3.
  const std::vector<Point2> points = { { 0, 0 }, { 10, 0 }, { 5, 5 }, { 5, 1 }, { 4, -1 },
    { 6.5, -1 } };
  std::vector<LocatedTriangle> triangles;
  for (const Corners& t : { Corners{ 0, 4, 2 }, Corners{ 2, 4, 3 }, Corners{ 3, 4, 5 },
         Corners{ 2, 3, 5 }, Corners{ 2, 5, 1 } })
  {
    triangles.push_back(
      { t, { points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])] } });
  }
  const std::set<Corners> found = withStrip(triangles, 0, 1);
  EXPECT_EQ(5U, found.size());
  EXPECT_EQ(1U, found.count({ 0, 3, 2 }));
  EXPECT_EQ(1U, found.count({ 1, 2, 3 }));
}

TEST(TriangleStrip, ACrossedConstraintIsFound)
{
  // The edge from 1 to 3 crosses the segment from 0 to 2.
  const std::vector<LocatedTriangle> triangles = {
    { { 0, 1, 3 }, { { { 0, 0 }, { 1, -1 }, { 1, 1 } } } },
    { { 1, 2, 3 }, { { { 1, -1 }, { 2, 0 }, { 1, 1 } } } },
  };
  TriangleStrip strip;
  EXPECT_THROW(strip.follow(triangles.data(), triangles.size(), 0, 2,
                 [](PointId p, PointId q) { return std::min(p, q) == 1 && std::max(p, q) == 3; }),
    CrossingFound);
}

/// How often a comparison of view angles decides. Fails if it does not agree with inCircle().
std::size_t decidedComparisons(const std::vector<Point2>& onLeft, Point2 from, Point2 to)
{
  std::size_t decided = 0;
  for (const Point2 one : onLeft)
  {
    for (const Point2 other : onLeft)
    {
      bool isDecided = true;
      const bool isLarger =
        ViewAngle(from, to, one)
          .isLarger(ViewAngle(from, to, other), [&] { return isDecided = false; });
      if (isDecided)
      {
        ++decided;
        EXPECT_EQ(isLarger ? 1 : -1, inCircle(from, to, other, one));
      }
    }
  }
  return decided;
}

TEST(ViewAngle, AgreesWithTheCircleTestForCoordinatesOfAnyMagnitude)
{
  for (const double scale : { 1e-200, 1e-150, 1e-81, 1e-75, 1.0, 1e70, 1e80, 1e150, 1e300 })
  {
    std::vector<Point2> onLeft;
    for (const Point2 p : randomPoints(50))
    {
      onLeft.push_back({ scale * p.x, scale * (p.y + 0.1) });
    }
    const std::size_t decided = decidedComparisons(onLeft, { 0, 0 }, { scale, 0 });
    EXPECT_TRUE(scale != 1 || decided == 50 * 49) << decided;
  }
}

TEST(ViewAngle, AgreesWithTheCircleTestForPointsNearACircle)
{
  std::vector<Point2> onLeft;
  for (int i = 1; i < 60; ++i)
  {
    constexpr double step = 0.05;
    onLeft.push_back({ 3 + std::cos(i * step), 5 + std::sin(i * step) });
    onLeft.push_back({ std::nextafter(onLeft.back().x, 9), onLeft.back().y });
  }
  decidedComparisons(onLeft, { 2, 5 }, { 4, 5 });
}

} // namespace
