// SPDX-License-Identifier: BSD-3-Clause
// Segments inserted into a region of triangles, with a mesh and without one.
#include "Comparison.h"
#include "PointSets.h"

#include "Constraints/Insertion/ConstraintRegion.h"
#include "Constraints/Insertion/TriangleStrip.h"
#include "Triangulation/TriangleSink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <set>
#include <vector>

namespace
{

using namespace tipp;

using Corners = std::array<PointId, 3>;

/// A region of triangles of these points.
void fillRegion(ConstraintRegion& region, const std::vector<Point2>& points,
  const std::vector<Corners>& triangles)
{
  region.clear();
  for (const Corners& t : triangles)
  {
    region.add(
      t, { points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])] });
  }
  region.finish();
}

/// The region's triangles, each from its lowest corner.
std::set<Corners> trianglesIn(const ConstraintRegion& region)
{
  std::set<Corners> all;
  for (std::size_t i = 0; i < region.triangleCount(); ++i)
  {
    all.insert(TriangleSink<PointId>::fromLowest(region.triangle(i)));
  }
  return all;
}

std::vector<LocatedTriangle> located(
  const std::vector<Point2>& points, const std::vector<Corners>& triangles)
{
  std::vector<LocatedTriangle> all;
  for (const Corners& t : triangles)
  {
    all.push_back(
      { t, { points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])] } });
  }
  return all;
}

/// The triangles that replace those crossed by the segment between points a and b.
std::set<Corners> withStrip(
  const std::vector<Point2>& points, const std::vector<Corners>& crossed, PointId a, PointId b)
{
  TriangleStrip strip;
  strip.follow(
    located(points, crossed).data(), crossed.size(), a, b, [](PointId, PointId) { return false; });
  std::set<Corners> all;
  strip.triangulate(
    [&](const Corners& corners) { all.insert(TriangleSink<PointId>::fromLowest(corners)); });
  return all;
}

/// Compares segments from point 0 in the Delaunay triangulation. Returns how many cross triangles.
int compareStripsWithRegions(const std::vector<Point2>& points, const std::vector<PointId>& ends)
{
  const auto at = [&](PointId id) { return points[std::size_t(id)]; };
  const test::Triangles mesh = test::trianglesOf(triangulate(PointsView(points), {}));
  int compared = 0;
  for (const PointId b : ends)
  {
    std::vector<Corners> crossed;
    std::copy_if(mesh.begin(), mesh.end(), std::back_inserter(crossed),
      [&](const Corners& t)
      {
        return crossProperly(at(0), at(b), at(t[0]), at(t[1])) ||
          crossProperly(at(0), at(b), at(t[1]), at(t[2])) ||
          crossProperly(at(0), at(b), at(t[2]), at(t[0]));
      });
    if (!crossed.empty())
    {
      ConstraintRegion region;
      fillRegion(region, points, crossed);
      region.insert(0, b);
      EXPECT_EQ(trianglesIn(region), withStrip(points, crossed, 0, b)) << "to point " << b;
      ++compared;
    }
  }
  return compared;
}

TEST(ConstraintRegion, ASegmentFromAVertexBetweenTwoGapsIsInserted)
{
  // Two quadrilaterals that have only vertex 0 in common.
  const std::vector<Point2> points = { { 0, 0 }, { 2, -1 }, { 3, 0 }, { 2, 1 }, { -2, 1 },
    { -3, 0 }, { -2, -1 } };
  ConstraintRegion region;
  fillRegion(region, points, { { 0, 1, 3 }, { 1, 2, 3 }, { 0, 4, 6 }, { 4, 5, 6 } });
  region.insert(0, 2);
  region.insert(5, 0);
  EXPECT_EQ(
    (std::set<Corners>{ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 4, 5 }, { 0, 5, 6 } }), trianglesIn(region));
}

TEST(ConstraintRegion, AnEdgeWhoseTrianglesAreBothCrossedIsKept)
{
  // The segment from 0 to 1 crosses all triangles, but not the edge from 2 to 3.
  const std::vector<Point2> points = { { 0, 0 }, { 10, 0 }, { 5, 5 }, { 5, 1 }, { 4, -1 },
    { 6.5, -1 } };
  ConstraintRegion region;
  const std::vector<Corners> crossed = { { 0, 4, 2 }, { 2, 4, 3 }, { 3, 4, 5 }, { 2, 3, 5 },
    { 2, 5, 1 } };
  fillRegion(region, points, crossed);
  region.insert(0, 1);
  const std::set<Corners> triangles = trianglesIn(region);
  EXPECT_EQ(5U, triangles.size());
  for (const Corners& wanted : { Corners{ 0, 1, 3 }, Corners{ 0, 3, 2 }, Corners{ 1, 2, 3 } })
  {
    EXPECT_EQ(1U, triangles.count(wanted));
  }
  EXPECT_EQ(triangles, withStrip(points, crossed, 0, 1));
  region.insert(2, 3); // it has become an edge again, and can be fixed
  EXPECT_EQ(triangles, trianglesIn(region));
}

TEST(ConstraintRegion, ASegmentOutsideChangesNothing)
{
  const std::vector<Point2> points = { { 0, 0 }, { 2, -1 }, { 3, 0 }, { 2, 1 }, { -2, 1 },
    { -3, 0 }, { -2, -1 } };
  const std::vector<Corners> before = { { 0, 1, 3 }, { 1, 2, 3 }, { 0, 4, 6 }, { 4, 5, 6 } };
  ConstraintRegion region;
  fillRegion(region, points, before);
  region.insert(3, 4);
  EXPECT_EQ(std::set<Corners>(before.begin(), before.end()), trianglesIn(region));
}

TEST(TriangleStrip, ItsTrianglesAreThoseOfARegion)
{
  std::vector<Point2> points;
  const test::Coordinates xy = test::makePointSet("uniform", 400);
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    points.push_back({ xy[i], xy[i + 1] });
  }
  std::vector<PointId> ends(100);
  std::iota(ends.begin(), ends.end(), 1);
  EXPECT_GT(compareStripsWithRegions(points, ends), 90);
}

TEST(TriangleStrip, PointsOfALatticeFollowTheTieRule)
{
  constexpr PointId side = 12;
  std::vector<Point2> points;
  for (PointId i = 0; i < side * side; ++i)
  {
    points.push_back({ double(i % side), double(i / side) });
  }
  EXPECT_EQ(4, // no lattice point is on these segments
    compareStripsWithRegions(points, { 7 + 5 * side, 11 + 10 * side, 1 + 11 * side, 11 + side }));
}

TEST(TriangleStrip, ACrossedConstraintIsFound)
{
  const std::vector<LocatedTriangle> triangles =
    located({ { 0, 0 }, { 1, -1 }, { 2, 0 }, { 1, 1 } }, { { 0, 1, 3 }, { 1, 2, 3 } });
  TriangleStrip strip;
  EXPECT_THROW(strip.follow(triangles.data(), triangles.size(), 0, 2,
                 [](PointId p, PointId q) { return std::min(p, q) == 1 && std::max(p, q) == 3; }),
    CrossingFound);
}

} // namespace
