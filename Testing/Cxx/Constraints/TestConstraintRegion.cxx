// SPDX-License-Identifier: BSD-3-Clause
// Segments inserted into a region of triangles.
#include "Constraints/Insertion/ConstraintRegion.h"
#include "Triangulation/TriangleSink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
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
  fillRegion(region, points, { { 0, 4, 2 }, { 2, 4, 3 }, { 3, 4, 5 }, { 2, 3, 5 }, { 2, 5, 1 } });
  region.insert(0, 1);
  const std::set<Corners> triangles = trianglesIn(region);
  EXPECT_EQ(5U, triangles.size());
  for (const Corners& wanted : { Corners{ 0, 1, 3 }, Corners{ 0, 3, 2 }, Corners{ 1, 2, 3 } })
  {
    EXPECT_EQ(1U, triangles.count(wanted));
  }
  region.insert(2, 3); // it has become an edge again, and can be fixed
  EXPECT_EQ(triangles, trianglesIn(region));
}

TEST(ConstraintRegion, ACrossedConstraintIsFound)
{
  const std::vector<Point2> points = { { 0, 0 }, { 1, -1 }, { 2, 0 }, { 1, 1 } };
  ConstraintRegion region;
  fillRegion(region, points, { { 0, 1, 3 }, { 1, 2, 3 } });
  region.fixEdges([](PointId p, PointId q) { return std::min(p, q) == 1 && std::max(p, q) == 3; });
  EXPECT_THROW(region.insert(0, 2), CrossingFound);
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

} // namespace
